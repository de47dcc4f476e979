// Bodies of a rope world that cannot pass through each other.
//
//     world.set_collides(line, line, true);   // a rope and itself
//     world.set_collides(line, other, true);  // two ropes
//
// Off unless switched on, and then without cost. Ropes are as thick as their radius says, all along: contacts
// are between segments, not particles. Parts of a rope closer than pi times its radius along it never touch.
//
// With Solver::Direct, contacts and their friction (Settings::friction) are solved together with lengths and
// colliders. A contact is a Lagrange multiplier that continues from substep to substep (an augmented
// Lagrangian: C. Giles, E. Diaz, C. Yuksel, "Augmented Vertex Block Descent", 2025), so its error vanishes at
// rest, but a blow may press ropes into each other for some substeps. The other solvers, and ropes with ties,
// only project contacts, after lengths.
//
// Whatever the solver left, a last check keeps the centre lines of segments from crossing: a step that would
// cross two is corrected, and if that fails taken only in part by all bodies that collide with each other,
// pins included (Advance::held_back). A collider may then overlap a rope for a while. Edits (set_radius,
// move, pins dragged while paused) are not checked.
#pragma once

#include <cstdint>

#include "tendril/rope/handle.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rope {

/// Two bodies that cannot pass through each other, or one that cannot pass through itself.
struct Collision {
    BodyId a, b;  ///< in the order of their slots
    bool operator==(const Collision&) const = default;
};

/// Two segments that press on each other.
struct BodyContact {
    std::uint32_t a = 0, b = 0;  ///< the particles that they begin at; a < b
    glm::dvec3 force{0.0};       ///< on b, newtons, in the last substep, with friction
    bool operator==(const BodyContact&) const = default;
};

}  // namespace tendril::rope
