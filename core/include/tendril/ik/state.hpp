// What a solver must remember from one solve to the next: a plain value. Copy it, compare it, save it, put it
// back: the next solve then gives the same bits as it did the first time. Rollback is a copy and an
// assignment.
//
// Joints are not part of it: they are the caller's. Everything else that a Solver holds is scratch.
//
// A state is made for a number of bones, by Solver::initial_state() or State(bones). Solving writes to it and
// does not allocate; copying to a state of as many bones does not allocate either.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tendril/ik/pole_turn.hpp"
#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

/// How the last solve with a pole left the chain, so that the next one turns it no faster than its joints may
/// move. All positions are relative to the root, in metres, so the chain may be moved as a whole.
struct PoleMemory {
    bool valid = false;  ///< whether the last solve had a pole; if not, the rest is not used
    PoleTurn turn = PoleTurn::WholeChain;  ///< how the chain was turned to face it
    glm::vec3 pole{0.0f};                  ///< metres
    glm::vec3 target{0.0f};                ///< metres
    float twist = 0.0f;                    ///< radians; of Method::TwoBone
    std::vector<glm::vec3> joints{};       ///< metres, one more than bones: where the solve left them

    bool operator==(const PoleMemory&) const = default;
};

/// How the last solve by Method::Fabrik within limits went, so that the next one goes on from there while the
/// target is dragged (Options::restarts).
struct LimitMemory {
    bool valid = false;      ///< whether there was one; if not, the rest is not used
    bool limited = false;    ///< whether it ended Limited or Stalled: then it goes on while every step gains
    glm::vec3 target{0.0f};  ///< metres from the root
    float damping = 0.0f;    ///< of its last least-squares step, in reach squared; 0 to 100

    bool operator==(const LimitMemory&) const = default;
};

struct State {
    State() = default;
    /// Bones are turned as at rest, and nothing is remembered.
    explicit State(std::size_t bones);

    /// One a bone: the unit quaternion that takes the bone from its rest direction to where it lies, in the
    /// world. Many do; which one depends on the solves before: each solve that keeps them up
    /// (Options::rotations) turns a bone on by the minimal rotation (parallel transport), so that twist has a
    /// meaning.
    std::vector<glm::quat> rotations{};
    PoleMemory pole{};
    LimitMemory limits{};

    std::size_t bones() const noexcept { return rotations.size(); }
    /// As it was made: for a chain that is put back to its rest pose. Does not allocate.
    void reset() noexcept;

    bool operator==(const State&) const = default;
};

/// Whether a solver of so many bones takes this state: lists of the right size, unit quaternions (to 1e-3),
/// numbers that are finite and at most max_magnitude. For states that come from files; a solve refuses a bad
/// one too, with Status::InvalidInput.
Result check(const State& state, std::size_t bones) noexcept;

/// Each bone's rotation against the bone before it (the first one's: against the world), as engines store
/// them: conjugate(rotations[i - 1]) * rotations[i]. `out` has as many elements as there are bones; if not,
/// nothing is written. The two may not overlap.
Result local_rotations(const State& state, std::span<glm::quat> out) noexcept;

}  // namespace tendril::ik
