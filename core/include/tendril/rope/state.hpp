// The whole state of a rope world, without anything that can be derived from it: save it, compare it, restore
// it. Two worlds with the same state continue the same, bit for bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tendril/rope/body.hpp"
#include "tendril/rope/collider.hpp"
#include "tendril/rope/collision.hpp"
#include "tendril/rope/settings.hpp"
#include "tendril/rope/tie.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rope {

/// A pinned particle.
struct Pin {
    std::size_t particle = 0;
    glm::dvec3 goal{0.0};  ///< destination; if attached, relative to the collider's centre
    double seconds = 0.0;  ///< simulated time until it arrives; 0: within the next substep
    ColliderId collider;   ///< moves the pin; empty: none
    bool operator==(const Pin&) const = default;
};

struct State {
    Settings settings;
    std::vector<Body> bodies;  ///< in the order of their particles
    std::vector<Link> links;
    std::vector<glm::dvec3> position;
    std::vector<glm::dvec3> displacement;  ///< in the last substep, metres; reduced if it gained energy
    std::vector<double> mass;              ///< kg, over 0
    std::vector<Pin> pins;                 ///< sorted by particle
    std::vector<Collider> colliders;
    /// Generation of each slot: how often it was taken and freed; odd while taken.
    std::vector<std::uint32_t> body_slots, collider_slots;
    std::vector<Tie> ties;
    std::vector<std::uint32_t> tie_slots;
    std::vector<Collision> collisions;  ///< sorted by slots
    std::vector<BodyContact> contacts;  ///< sorted by particles
    double remainder = 0.0;             ///< seconds not simulated yet
    double displaced_in = 0.0;          ///< seconds of the last substep; 0: nothing has moved yet
    std::uint64_t substeps = 0, dropped = 0;
    glm::dvec3 drift{0.0};  ///< how far the wind has carried the gusts, metres; repeats after 2^20 m

    bool operator==(const State&) const = default;
};

/// Assigns handles to the bodies, colliders and ties of a hand-made state, in order from slot 0. A list whose
/// first element has a handle keeps its own.
void number_slots(State& state);

}  // namespace tendril::rope

/// All fields but `collider`.
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Pin>() noexcept;
