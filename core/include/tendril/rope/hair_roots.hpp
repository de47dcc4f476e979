// Roots of a patch of hair: evenly spread, free or on a collider.
#pragma once

#include <optional>
#include <vector>

#include "tendril/result.hpp"
#include "tendril/rope/body.hpp"
#include "tendril/rope/collider.hpp"

namespace tendril::rope {

/// A round patch of strands, arranged like the seeds of a sunflower, which is even for any number (H. Vogel,
/// "A better way to construct the sunflower head", 1979).
struct HairPatch {
    glm::vec3 centre{0.0f};                ///< for a free patch
    std::optional<glm::vec3> direction{};  ///< growth; default: down; on colliders up, on planes outward
    int strands = 32;
    float spread = 0.1f;  ///< radius of the patch, metres
};

/// Roots in a plane, all in one direction. Refuses a field out of its range and a direction of length 0.
Expected<std::vector<HairRoot>> roots_around(const HairPatch& patch);

/// Roots on the surface of a collider, on the side that `direction` points to, each along the surface's
/// normal and `lift` metres off it. Refuses a field out of its range and a direction of length 0.
Expected<std::vector<HairRoot>> roots_on(const Shape& shape, const HairPatch& patch, float lift);

}  // namespace tendril::rope

template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::HairPatch>() noexcept;
