// Inverse kinematics of one chain: the root stays, the tip goes to a target.
//
// n bones connect n + 1 joints; joint 0 is the root, joint n the tip. A tendril::Chain of n + 1 segments has
// n bones, for the length of its head is none.
//
// A Solver holds what does not change from solve to solve (lengths, rest directions), the room to work in,
// and two things that do: how each bone is turned about itself, which limits need to know and positions
// cannot tell, and the pose in which the last solve with a pole left the chain, so that the next one turns it
// no faster than joints may move. So make one per chain and keep it. Solving allocates nothing, throws
// nothing and gives the same bits for the same calls in the same order.
//
// Before the first iteration, in O(n): what is out of reach or too close is answered at once, and a chain
// that lies on one line with its target, where no method would bend it, is given a small bow, always the same
// (but not for Method::FabrikPlain, which stalls there); within limits to a side to which its joints may
// bend, and also later where it stalls on a line. A solve that would end worse than it began, or than it once
// was, ends with the nearest pose that it met.
//
// Cost: O(n) an iteration for every method; where limits stop one short, a few more to tell Limited from
// Stalled.
//
// Bones keep their lengths as in chain.hpp, except that Method::TwoBone may stretch them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "tendril/chain/chain.hpp"
#include "tendril/ik/hold.hpp"
#include "tendril/ik/observer.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik {

enum class Method : std::uint8_t {
    Fabrik,             ///< FABRIK with a step that takes the bend out near full reach: the default
    FabrikPlain,        ///< as Aristidou and Lasenby published it in 2011, for study; stalls on a line
    Ccd,                ///< cyclic coordinate descent (Wang and Chen 1991)
    JacobianTranspose,  ///< with the step that is best along the gradient (Buss 2004)
    Dls,                ///< damped least squares (Wampler 1986, Nakamura and Hanafusa 1986)
    SvdDls,             ///< the same, damped singular value by singular value (Maciejewski and Klein 1988)
    TwoBone             ///< law of cosines; two bones only
};
inline constexpr std::array all_methods{
    Method::Fabrik, Method::FabrikPlain, Method::Ccd,    Method::JacobianTranspose,
    Method::Dls,    Method::SvdDls,      Method::TwoBone};
/// "fabrik_plain": as commands and files name it.
const char* name(Method method) noexcept;
/// None for an unknown name.
std::optional<Method> method_named(std::string_view name) noexcept;

class Solver {
  public:
    /// `rest_directions`: where each bone points at rest, unit vectors, one a bone; all along +X where left
    /// out. Throws std::invalid_argument for a length that chain.hpp would not take, a direction that is no
    /// unit vector (to 1e-3), or a number of directions that is neither 0 nor that of the lengths.
    explicit Solver(std::span<const float> lengths, std::span<const glm::vec3> rest_directions = {});
    /// The bones of a chain; at rest they lie along its default direction.
    explicit Solver(const Chain& chain);
    ~Solver();
    Solver(Solver&&) noexcept;
    Solver& operator=(Solver&&) noexcept;

    std::size_t bones() const noexcept;
    /// Sum of the lengths, metres.
    float reach() const noexcept;

    /// Moves the joints (bones() + 1 of them, metres), all but the first, so that the last comes to the
    /// target. What it starts from is laid to the bones' lengths first, if it was not.
    Report solve(Method method, std::span<glm::vec3> joints, glm::vec3 target, const Options& options = {},
                 Observer* observer = nullptr) noexcept;
    /// The same for a chain of bones() + 1 segments. A chain keeps its lengths: two bones do not stretch. And
    /// it takes no coordinate over max_magnitude: where the solve would lead there, the chain stays as it is
    /// and the status is InvalidInput.
    Report solve(Method method, Chain& chain, glm::vec3 target, const Options& options = {},
                 Observer* observer = nullptr) noexcept;

    /// After a solve that ended Limited: which joint holds the tip back. That is the one whose freeing,
    /// alone, brings the tip nearest to the target. `joints` are those that the solve left; they are not
    /// moved. None where no single joint's freeing brings it nearer, or the input is not valid.
    std::optional<Hold> explain(Method method, std::span<const glm::vec3> joints, glm::vec3 target,
                                const Options& options) noexcept;

    /// How each bone is turned against its rest, in the world; carried along by the least rotation as the
    /// chain moves, and kept up only by solves with limits or a tip orientation. 1 before the first.
    std::span<const glm::quat> rotations() const noexcept;
    /// Continues from saved ones. False, and nothing is changed, where the number is not bones() or one is no
    /// unit quaternion.
    bool set_rotations(std::span<const glm::quat> rotations) noexcept;
    /// Bones are turned as at rest again.
    void forget_rotations() noexcept;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::ik
