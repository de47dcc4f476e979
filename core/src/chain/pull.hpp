// A pull: one pass over a chain that repeats the step of math/point.hpp. Not installed.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "math/point.hpp"
#include "tendril/chain/segment.hpp"

namespace tendril::detail {

using namespace tendril::math;

/// Moves segment `pinned` to `target`, then places the segments after it, up to the tail. `pinned` must be a
/// valid index.
static inline void pull_towards_tail(std::span<Segment> segments, std::size_t pinned, glm::vec3 target,
                                     const glm::vec3& fallback) noexcept {
    segments[pinned].position = target;
    for (std::size_t i = pinned + 1; i < segments.size(); ++i) {
        target = step(target, segments[i].position, segments[i].length, fallback);
        segments[i].position = target;
    }
}

/// Moves segment `pinned` to `target`, then places the segments before it, down to the head, each at its
/// already placed neighbour's length from that neighbour.
static inline void pull_towards_head(std::span<Segment> segments, std::size_t pinned, glm::vec3 target,
                                     const glm::vec3& fallback) noexcept {
    segments[pinned].position = target;
    float length = segments[pinned].length;
    for (std::size_t i = pinned; i > 0; --i) {
        Segment& segment = segments[i - 1];
        target = step(target, segment.position, length, fallback);
        segment.position = target;
        // Kept in a variable: a load next to a coordinate just written would wait for the store.
        length = segment.length;
    }
}

}  // namespace tendril::detail
