// The memory of a solver from one solve to the next: a plain value. Copy it, compare it, save it, restore it:
// the next solve then gives the same bits as it did the first time. Rollback is a copy and an assignment.
//
// The joints are not part of it: the caller owns them. Everything else that a Solver holds is scratch.
//
// A state is made for a number of bones, by Solver::initial_state() or State(bones). Solving writes to it
// without allocating, and so does copying to a state with as many bones.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/ik/plane.hpp"
#include "tendril/ik/pole_turn.hpp"
#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

/// Records how the last solve with a pole left the chain, so that the next one can limit how fast it turns.
/// All positions are relative to the root, in metres, so the chain may be moved as a whole.
struct PoleMemory {
    bool valid = false;                    ///< the last solve had a pole; otherwise the rest is unused
    PoleTurn turn = PoleTurn::WholeChain;  ///< how the chain was turned to face it
    glm::vec3 pole{0.0f};                  ///< metres
    glm::vec3 target{0.0f};                ///< metres
    float twist = 0.0f;                    ///< radians; Method::TwoBone only
    std::vector<glm::vec3> joints{};       ///< metres, bones + 1: the joints after that solve

    bool operator==(const PoleMemory&) const = default;
};

/// Records how the last solve by Method::Fabrik within limits went, so that the next one can continue from
/// there while the target is dragged (Options::restarts).
struct LimitMemory {
    bool valid = false;      ///< there was such a solve; otherwise the rest is unused
    bool limited = false;    ///< ended Limited or Stalled; the next stops at a step without gain
    glm::vec3 target{0.0f};  ///< metres from the root
    float damping = 0.0f;    ///< damping of its last least-squares step, in squares of the reach; 0 to 100

    bool operator==(const LimitMemory&) const = default;
};

struct State {
    State() = default;
    /// All bones at rest, with no memory.
    explicit State(std::size_t bones);

    /// One per bone: the unit quaternion that rotates the bone from its rest direction to its current one, in
    /// the world. It is not unique and depends on earlier solves: each solve that updates it
    /// (Options::rotations) applies the minimal rotation (parallel transport), so that twist is meaningful.
    std::vector<glm::quat> rotations{};
    PoleMemory pole{};
    LimitMemory limits{};
    Side side = Side::Free;  ///< side on which the last solve left a chain in a plane; Free before the first

    std::size_t bones() const noexcept { return rotations.size(); }
    /// Restores the initial state, for a chain that returns to its rest pose. Does not allocate.
    void reset() noexcept;

    bool operator==(const State&) const = default;
};

/// Checks that a state fits a solver with this many bones: lists of the right size, unit quaternions (to
/// 1e-3), finite numbers, limits.damping 0 to 100. For states that come from files. A solve checks sizes,
/// quaternions and limits.damping itself, and the rest if pole.valid; it refuses a bad state with
/// Status::InvalidInput.
Result check(const State& state, std::size_t bones) noexcept;

/// Each bone's rotation relative to its parent bone (the first one's: to the world), as engines store it:
/// conjugate(rotations[i - 1]) * rotations[i]. `out` needs one element per bone, otherwise nothing is
/// written. It must not overlap the state's rotations.
Result local_rotations(const State& state, std::span<glm::quat> out) noexcept;

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::PoleMemory>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LimitMemory>() noexcept;
