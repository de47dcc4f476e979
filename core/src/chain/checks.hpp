// A refusal that belongs to chains; those of single numbers are in math/checks.hpp. Not installed.
#pragma once

#include <string_view>

#include "math/checks.hpp"
#include "tendril/chain/segment.hpp"

namespace tendril::detail {

/// Position and length, each in its range; `argument` without member.
Result check_segment(std::string_view operation, const Argument& argument, const Segment& value) noexcept;

}  // namespace tendril::detail
