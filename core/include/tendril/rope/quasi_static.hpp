// Quasi-static drag: moves a pin or a collider while the simulation is paused, and displaces bodies in its
// way as if they had no weight or speed. Nothing else moves; moves in progress resume when time runs.
//
// Method: in a copy of the world gravity is 0, damping is full, and every link's rest length is its current
// length, except for stiff links (direct solver, no compliance) that are over 5 % off. Eight substeps move
// the dragged pins or collider to their goal; the resulting positions become the world's. Costs a copy of the
// state and eight substeps.
#pragma once

#include <span>

#include "tendril/rope/world.hpp"

namespace tendril::rope {

/// A particle, and where to pin it, metres.
struct PinPlace {
    std::size_t particle = 0;
    glm::dvec3 to{0.0};
};

/// Moves several pins at once, at the cost of one. Pins free particles, and detaches those that a collider
/// holds. Refuses a particle that is named twice; if any is refused, nothing moves.
Result drag_pins(World& world, Workspace& workspace, std::span<const PinPlace> pins);
/// The same for one pin.
Result drag_pin(World& world, Workspace& workspace, std::size_t particle, const glm::dvec3& to);
Result drag_collider(World& world, Workspace& workspace, ColliderId collider, const glm::vec3& to);
/// Replaces the collider's shape.
Result drag_collider(World& world, Workspace& workspace, ColliderId collider, const Shape& shape);

}  // namespace tendril::rope
