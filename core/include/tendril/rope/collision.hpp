// Bodies of a rope world that cannot pass through each other.
//
//     world.set_collides(line, line, true);   // a rope and itself
//     world.set_collides(line, other, true);  // two ropes
//
// Off unless switched on, and then without cost. Ropes and cloth are as thick as their radius says, all over:
// contacts are between segments, and between particles and the triangles of cloth. Parts of a body closer
// than pi times its radius along it never touch. Hair does not collide.
//
// With Solver::Direct, contacts of ropes and their friction (Settings::friction) are solved together with
// lengths and colliders. A contact is a Lagrange multiplier that continues from substep to substep (an
// augmented Lagrangian: C. Giles, E. Diaz, C. Yuksel, "Augmented Vertex Block Descent", 2025), so its error
// vanishes at rest, but a blow may press ropes into each other for some substeps. Contacts within a cloth are
// springs in its own implicit step, so that its layers rest on each other and lie still. Those of cloth with
// anything else, and of what has ties, are projected after the solve, in turns with lengths and colliders;
// the other solvers project all.
//
// Whatever the solver left, a last check keeps segments from crossing, and particles from triangles (R.
// Bridson, R. Fedkiw, J. Anderson, "Robust Treatment of Collisions, Contact and Friction for Cloth
// Animation", 2002): a step in which two would is corrected, and if that fails taken only in part by all
// bodies that collide with each other, pins included (Advance::held_back). A collider may then overlap a body
// for a while. Edits (set_radius, move, pins dragged while paused) are not checked.
//
// Ropes that collide but are apart cost a tenth to a fifth more. Ropes in contact cost four to seven times
// what they would cost without, and a heap of cloth five to eight times.
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

/// Two segments of ropes that press on each other.
struct BodyContact {
    std::uint32_t a = 0, b = 0;  ///< the particles that they begin at; a < b
    glm::dvec3 force{0.0};       ///< on b, newtons, in the last substep, with friction
    bool operator==(const BodyContact&) const = default;
};

}  // namespace tendril::rope
