// Where the strands of a patch of hair grow: evenly spread roots, free or on a collider.
#pragma once

#include <optional>
#include <vector>

#include "tendril/result.hpp"
#include "tendril/rope/body.hpp"
#include "tendril/rope/collider.hpp"

namespace tendril::rope {

/// A round patch of strands, in the order of the seeds of a sunflower, which are evenly spread at any number
/// (H. Vogel, "A better way to construct the sunflower head", 1979).
struct HairPatch {
    glm::vec3 centre{0.0f};              ///< of a free patch
    std::optional<glm::vec3> direction;  ///< that strands grow in; downwards, or upwards from a collider
    int strands = 32;
    float radius = 0.1f;  ///< metres
};

/// Flat, all in one direction. Refuses a direction of no length.
Expected<std::vector<HairRoot>> roots_around(const HairPatch& patch);

/// On the surface of a collider, on the side that `direction` points to, each along the surface's normal;
/// `lift` metres off it. Refuses a direction of no length.
Expected<std::vector<HairRoot>> roots_on(const Shape& shape, const HairPatch& patch, float lift);

}  // namespace tendril::rope
