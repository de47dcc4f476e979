// Argument checks for chains; those for single numbers are in math/checks.hpp. Not installed.
#pragma once

#include <string_view>

#include "math/checks.hpp"
#include "tendril/chain/segment.hpp"

namespace tendril::detail {

/// Checks the ranges of position and length; `argument` has no member.
Result check_segment(std::string_view operation, const Argument& argument, const Segment& value) noexcept;

}  // namespace tendril::detail
