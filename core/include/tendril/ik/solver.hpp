// Inverse kinematics of one chain: the root stays, the tip goes to a target.
//
// n bones connect n + 1 joints; joint 0 is the root, joint n the tip. A tendril::Chain of n + 1 segments has
// n bones: the length of its head is not used.
//
// A Solver holds what does not change from solve to solve (lengths, rest directions) and scratch memory; so
// make one per chain and keep it. What a solve needs from earlier ones is in the State, which the caller
// keeps beside the joints. Solving allocates nothing, throws nothing, and gives the same bits for the
// same joints, state, target and options, whatever the solver did before.
//
// Before the first iteration, in O(n): what is out of reach or too close is answered at once, and a chain
// that lies on one line with its target, where no method would bend it, is given a small bend, always the
// same (but not for Method::FabrikPlain, which stalls there); within limits to a side to which its joints may
// bend, and also later where it stalls on a line. A solve that would end worse than it began, or than it once
// was, ends with the nearest pose that it met.
//
// Cost: O(n) an iteration for every method; where limits stop one short, a few more to distinguish Limited
// from Stalled.
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
    /// `rest_directions`: where each bone points at rest, unit vectors, one a bone; all along +X where left
    /// out. Refuses a length that chain.hpp would not take, a direction that is no unit vector (to 1e-3), and
    /// a number of directions that is neither 0 nor that of the lengths.
    static Expected<Solver> make(std::span<const float> lengths,
                                 std::span<const glm::vec3> rest_directions = {});
    /// The bones of a chain; at rest they lie along its default direction.
    explicit Solver(const Chain& chain);
    ~Solver();
    Solver(Solver&&) noexcept;
    Solver& operator=(Solver&&) noexcept;

    std::size_t bones() const noexcept;
    /// Sum of the lengths, metres.
    float reach() const noexcept;
    /// A state for this chain: as at rest, with nothing remembered.
    State initial_state() const { return State(bones()); }

    /// Moves the joints (bones() + 1 of them, metres), all but the first, so that the last comes to the
    /// target. What it starts from is brought to the bones' lengths first, if it was not. `state` goes with
    /// the joints from solve to solve. InvalidInput changes neither.
    Report solve(Method method, std::span<glm::vec3> joints, State& state, glm::vec3 target,
                 const Options& options = {}, Observer* observer = nullptr) noexcept;
    /// The same for a chain of bones() + 1 segments. A chain keeps its lengths: two bones do not stretch. And
    /// it takes no coordinate over max_magnitude: where the solve would lead there, chain and state stay as
    /// they are and the status is InvalidInput.
    Report solve(Method method, Chain& chain, State& state, glm::vec3 target, const Options& options = {},
                 Observer* observer = nullptr) noexcept;

    /// After a solve that ended Limited: which joint stops the tip. That is the one whose freeing,
    /// alone, brings the tip nearest to the target. `joints` and `state` are those that the solve left. None
    /// where no single joint's freeing brings it nearer, or the input is not valid. Of all joints that stand
    /// at their limits the four whose limits stop most of the descent to the target are tried.
    ///
    /// Cost: at most 17 further solves of at most 60 iterations each, whatever the number of bones: one to
    /// where the limits stop it, one or two for each of the four, eight to find the angle.
    std::optional<ActiveLimit> explain(std::span<const glm::vec3> joints, const State& state,
                                       glm::vec3 target, const Options& options) noexcept;

  private:
    struct Parts;
    explicit Solver(std::unique_ptr<Parts> parts) noexcept;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::ik
