// Inverse kinematics of one chain: the root stays, the tip moves to a target.
//
// n bones connect n + 1 joints; joint 0 is the root, joint n the tip. A tendril::Chain of n + 1 segments has
// n bones: the length of its head is not used.
//
// A Solver holds the constants of a chain (lengths, rest directions) and scratch memory, so make one per
// chain and keep it. Anything a solve needs from earlier ones is in the State, which the caller keeps with
// the joints. Solving does not allocate or throw, and gives the same bits for the same joints, state, target
// and options, whatever the solver did before.
//
// Before iterating, in O(n): targets out of reach or too close are solved in closed form, and a chain that is
// collinear with its target, which no method would bend, gets a small deterministic bend (except for
// Method::FabrikPlain, which stalls there). Within limits it bends to a side that its joints allow, and also
// later if it stalls on a line. A solve that would end worse than it began, or than its best pose, ends with
// that best pose.
//
// Cost: O(n) per iteration for every method. If limits stop a method, a few more iterations distinguish
// Limited from Stalled.
//
// Bones keep their lengths as in chain.hpp, except that Method::TwoBone may stretch them.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "tendril/chain/chain.hpp"
#include "tendril/ik/active_limit.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/ik/observer.hpp"
#include "tendril/ik/options.hpp"
#include "tendril/ik/state.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

class Solver {
  public:
    /// `rest_directions`: where each bone points at rest, one unit vector per bone; by default all along +X.
    /// InvalidArgument for a length that chain.hpp refuses, a direction that is not a unit vector (to 1e-3),
    /// or a number of directions that is neither 0 nor the number of lengths.
    static Expected<Solver> make(std::span<const float> lengths,
                                 std::span<const glm::vec3> rest_directions = {});
    /// Takes the bones of a chain. At rest they lie along its default direction.
    explicit Solver(const Chain& chain);
    ~Solver();
    Solver(Solver&&) noexcept;
    Solver& operator=(Solver&&) noexcept;

    std::size_t bones() const noexcept;
    /// Sum of the lengths, metres.
    float reach() const noexcept;
    /// A state for this chain: at rest, with no memory.
    State initial_state() const { return State(bones()); }

    /// Moves all joints but the first (bones() + 1 of them, metres) so that the last reaches the target. If
    /// the joints do not match the bones' lengths, they are corrected first. Keep `state` with the joints
    /// from solve to solve. InvalidInput changes neither, and Report::accepted says why: "solve: limits[1]
    /// must be a valid limit, got the hinge's axis lies along the bone".
    Report solve(Method method, std::span<glm::vec3> joints, State& state, glm::vec3 target,
                 const Options& options = {}, Observer* observer = nullptr) noexcept;
    /// The same for a chain of bones() + 1 segments. A chain keeps its lengths: two bones do not stretch. It
    /// also takes no coordinate over max_magnitude: if the solve would lead there, chain and state do not
    /// change and the status is InvalidInput.
    Report solve(Method method, Chain& chain, State& state, glm::vec3 target, const Options& options = {},
                 Observer* observer = nullptr) noexcept;

    /// After a solve that ended Limited: the joint that stops the tip, that is, the one that brings the tip
    /// nearest to the target if it alone is freed. Pass `joints` and `state` as the solve left them. None if
    /// freeing no single joint brings it nearer, or if the input is invalid. It tries the four joints whose
    /// limits stop most of the descent to the target.
    ///
    /// Cost: at most 17 further solves of at most 60 iterations each, whatever the number of bones: one to
    /// find where the limits stop the tip, one or two for each of the four joints, eight to find the angle.
    std::optional<ActiveLimit> explain(std::span<const glm::vec3> joints, const State& state,
                                       glm::vec3 target, const Options& options) noexcept;

  private:
    struct Parts;
    explicit Solver(std::unique_ptr<Parts> parts) noexcept;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::ik
