// What may come into the library, and the words with which it is refused. Not installed.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "tendril/chain/segment.hpp"

namespace tendril::detail {

// Each comparison is false for NaN, so NaN is never in range.
inline bool is_length(float value) noexcept {
    return value >= 0.0f && value <= max_magnitude;
}
inline bool is_coordinate(float value) noexcept {
    return std::abs(value) <= max_magnitude;
}
inline bool is_point(const glm::vec3& point) noexcept {
    return is_coordinate(point.x) && is_coordinate(point.y) && is_coordinate(point.z);
}

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
