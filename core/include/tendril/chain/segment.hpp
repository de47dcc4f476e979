// One segment of a chain.
#pragma once

#include "tendril/magnitude.hpp"
#include "tendril/vec3.hpp"

namespace tendril {

/// A point of a chain and its distance to the point before it.
struct Segment {
    glm::vec3 position{0.0f};  ///< metres, each coordinate finite and at most max_magnitude in magnitude
    float length = 0.0f;       ///< metres from the segment before, 0 to max_magnitude; no effect for a head

    bool operator==(const Segment&) const = default;
};

}  // namespace tendril
