// Refusals of what belongs to a chain, and those by exception for the rooms that do not answer with a Result
// yet (math/checks.hpp takes their place). Not installed.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "math/checks.hpp"
#include "tendril/chain/segment.hpp"

namespace tendril::detail {

/// Position and length, each in its range; `argument` without member.
Result check_segment(std::string_view operation, const Argument& argument, const Segment& value) noexcept;

/// The shortest text that reads back as the same float; `nan`, `inf` or `-inf` where it is not finite.
std::string text(float value);

/// These throw unless the value is in range: `operation: argument must be ..., got value`.
void require_length(std::string_view operation, std::string_view argument, float value);
void require_point(std::string_view operation, std::string_view argument, const glm::vec3& value);
void require_segment(std::string_view operation, std::string_view argument, const Segment& value);
void require_index(std::string_view operation, std::size_t index, std::size_t size);

/// std::invalid_argument: `operation: argument must be requirement, got value`.
[[noreturn]] void refuse(std::string_view operation, std::string_view argument, std::string_view requirement,
                         std::string_view value);

}  // namespace tendril::detail
