// Quasi-static drag: a pin or a collider is moved while the simulation is paused, and what it meets is
// displaced as if everything were without weight and speed. Nothing else moves, no time passes, and what was
// on its way somewhere goes on when time does.
//
// The world is copied with no gravity, full damping and every link at rest as long as it is, except stiff
// links (direct solver, no compliance) that are over 5 % off their length; eight substeps take what is
// dragged to its place; the positions that this gives are the world's. Costs a copy of the state and eight
// substeps.
#pragma once

#include <span>

#include "tendril/rope/world.hpp"

namespace tendril::rope {

/// Where a particle is to be pinned, metres.
struct PinPlace {
    std::size_t particle = 0;
    glm::dvec3 to{0.0};
};

/// Moves several at once, in the time of one. Pins those that are free, and detaches those that a collider
/// holds. Refuses a particle that is named twice; where one is refused nothing moves.
Result drag_pins(World& world, Workspace& workspace, std::span<const PinPlace> pins);
/// The same with one.
Result drag_pin(World& world, Workspace& workspace, std::size_t particle, const glm::dvec3& to);
Result drag_collider(World& world, Workspace& workspace, ColliderId collider, const glm::vec3& to);
/// Puts another shape in its place.
Result drag_collider(World& world, Workspace& workspace, ColliderId collider, const Shape& shape);

}  // namespace tendril::rope
