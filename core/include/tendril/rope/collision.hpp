// Collisions between the bodies of a rope world.
//
//     world.set_collides(line, line, true);   // a rope and itself
//     world.set_collides(line, other, true);  // two ropes
//
// Off by default, at no cost. Ropes and cloth collide at their radius everywhere: contacts are between
// segments, and between particles and triangles of cloth. Parts of a body closer than pi times its radius,
// measured along it, never touch. Hair does not collide.
//
// With Solver::Direct, contacts of ropes and their friction (Settings::friction) are solved together with
// lengths and colliders. A contact is a Lagrange multiplier that continues from substep to substep (an
// augmented Lagrangian: C. Giles, E. Diaz, C. Yuksel, "Augmented Vertex Block Descent", 2025), so its error
// vanishes at rest, but a blow may press ropes into each other for some substeps. Contacts within a cloth are
// springs in its own implicit step, so that its layers rest on each other and lie still. Other contacts of
// cloth, and contacts of tied bodies, are projected after the solve, alternating with lengths and colliders;
// the other solvers project all contacts.
//
// A final check keeps segments from crossing each other, and particles from crossing triangles (R. Bridson,
// R. Fedkiw, J. Anderson, "Robust Treatment of Collisions, Contact and Friction for Cloth Animation", 2002).
// It corrects such a step; if that fails, all colliding bodies take only a part of it, pins included
// (Advance::held_back). A collider may then overlap a body for a while. Edits (set_radius, move, pins dragged
// while paused) are not checked.
//
// Cost: ropes that may collide but are apart cost a tenth to a fifth more, ropes in contact four to seven
// times as much as without collisions, and a heap of cloth five to eight times.
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
    std::uint32_t a = 0, b = 0;  ///< first particle of each segment; a < b
    glm::dvec3 force{0.0};       ///< on b, newtons, in the last substep; with friction
    bool operator==(const BodyContact&) const = default;
};

}  // namespace tendril::rope
