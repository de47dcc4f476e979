// One segment of a chain, and the range of every number that may come in.
#pragma once

#include <glm/vec3.hpp>

namespace tendril {

/// The largest coordinate and the largest length that are accepted, in metres. Results are accurate within
/// 1e3 m of the origin: further out, floats stand too far apart (64 m at this limit), and only finiteness is
/// promised.
inline constexpr float max_magnitude = 1e9f;

/// A point of a chain and its distance to the point before it.
struct Segment {
    glm::vec3 position{0.0f};  ///< metres, each coordinate finite and at most max_magnitude in magnitude
    float length = 0.0f;       ///< metres from the segment before, 0 to max_magnitude; a head's ties nothing

    bool operator==(const Segment&) const = default;
};

}  // namespace tendril
