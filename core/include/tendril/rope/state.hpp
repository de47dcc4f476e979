// The whole state of a rope world, without anything that can be derived from it: save it, compare it, restore
// it. Two worlds with the same state continue the same, bit for bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tendril/rope/body.hpp"
#include "tendril/rope/collider.hpp"
#include "tendril/rope/settings.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rope {

inline constexpr std::size_t max_particles = 1'000'000;

/// A pinned particle.
struct Pin {
    std::size_t particle = 0;
    glm::dvec3 goal{0.0};  ///< where it is going; of one attached to a collider: from the collider's centre
    double seconds = 0.0;  ///< of simulated time until it is there; 0: it stays there
    ColliderId collider;   ///< that it moves with; empty: none
    bool operator==(const Pin&) const = default;
};

struct State {
    Settings settings;
    std::vector<Body> bodies;  ///< in the order of their particles
    std::vector<Link> links;
    std::vector<glm::dvec3> position;
    std::vector<glm::dvec3> displacement;  ///< by the last substep, metres; less where it gained energy
    std::vector<double> mass;              ///< kg, over 0
    std::vector<Pin> pins;                 ///< by particle
    std::vector<Collider> colliders;
    /// How often each slot was taken and freed: odd while it is taken.
    std::vector<std::uint32_t> body_slots, collider_slots;
    double remainder = 0.0;     ///< seconds that are not simulated yet
    double displaced_in = 0.0;  ///< seconds of the last substep; 0: nothing has moved yet
    std::uint64_t substeps = 0, dropped = 0;

    bool operator==(const State&) const = default;
};

/// Gives every body (collider) of a state that was put together by hand a handle, in their order, where the
/// first has none: slots are numbered from 0.
void number_slots(State& state);

}  // namespace tendril::rope
