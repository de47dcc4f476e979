// The field table of SpringState<double>. Not installed.
#pragma once

#include "tendril/magnitude.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::signal::detail {

inline constexpr Field spring_rows[] = {
    field<&SpringState<double>::value>("value", {-max_magnitude, max_magnitude}),
    field<&SpringState<double>::velocity>("velocity", {-max_magnitude, max_magnitude}, "1/s"),
    field<&SpringState<double>::previous_target>("previous", {-max_magnitude, max_magnitude})
        .as_member("previous_target"),
    field<&SpringState<double>::started>("started")};

}  // namespace tendril::signal::detail
