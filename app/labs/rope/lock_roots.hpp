// Where the strands of a lock of hair grow from.
#pragma once

#include <optional>
#include <tendril/rope/body.hpp>
#include <tendril/rope/collider.hpp>
#include <vector>

namespace tendril::app {

/// A round patch of strands, evenly spread.
struct LockPatch {
    glm::vec3 centre{0.0f};              ///< of a free patch
    std::optional<glm::vec3> direction;  ///< that strands grow in; downwards, or upwards from a collider
    int strands = 32;
    float spread = 0.1f;  ///< metres: the patch's radius
};

/// Flat, all in one direction. Throws std::invalid_argument where that is zero.
std::vector<rope::LockShape::Root> roots_around(const LockPatch& patch);

/// On the surface of a collider, on the side that `direction` points to, each along the surface's normal;
/// `lift` metres off it.
std::vector<rope::LockShape::Root> roots_on(const rope::Shape& shape, const LockPatch& patch, float lift);

}  // namespace tendril::app
