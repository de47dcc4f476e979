// Full-body IK: brings hands, feet, head and hips to their targets at once, starting from a clip's pose and
// within the joint limits.
//
//     Expected<Body> body = Body::make(skeleton, map, default_limits(skeleton, map));
//     BodyState state;  // not part of the document: where the last solve ended
//     sample(clip, skeleton, seconds, pose);
//     const Expected<BodyReport> report = body->solve(pose, targets, state);
//
// Among the poses that reach the targets, the solver looks for one close to the clip's. Each bone is weighted
// by its mobility: the arm moves a hand before the spine helps, and the spine before the hips. If targets
// conflict, least squares share the residual by weight. Feet without a target stay where the clip has them; a
// hand or the head without one moves with the body and keeps the clip's pose.
//
// Method: damped least squares over the rotations of all bones (Levenberg 1944, Marquardt 1963), damped by
// the residual (T. Sugihara, "Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt method",
// IEEE Transactions on Robotics 27(5), 2011), with the turn back to the clip's pose in the null space (A.
// Liegeois, "Automatic supervisory control of the configuration and behavior of multibody mechanisms", 1977).
// The equations have one row per target coordinate, not one column per rotation. A joint at its limit loses
// the direction that leads out of it (active set).
//
// Scaling a figure scales its pose, and mirroring it mirrors the pose, except for rounding. The order of the
// targets does not matter.
//
// An almost straight limb would have to bend infinitely fast to follow a target that approaches at constant
// speed. There the solver overestimates the bend slightly and stops up to 0.7 mm short (of a 1.8 m body), so
// that elbows and knees move at most about 13 times as fast as the target.
//
// FABRIK over layered chains is not used: it solves for positions and derives rotations afterwards, which
// loses the twist, and it has to apply limits in every pass.
//
// Cost: an iteration of 22 bones and 5 targets takes 2 to 3 microseconds; following a target that moves by a
// millimetre takes about 5 to 10 iterations. Measured by tests/bench/humanoid_body.cpp.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tendril/humanoid/capsules.hpp"
#include "tendril/humanoid/ground.hpp"
#include "tendril/humanoid/limits.hpp"

namespace tendril::humanoid {

enum class Effector : std::uint8_t { Hips, Head, LeftHand, RightHand, LeftFoot, RightFoot };
inline constexpr std::size_t effector_count = 6;
/// "left_hand"
const char* name(Effector effector) noexcept;
std::optional<Effector> effector_named(std::string_view name) noexcept;
Bone bone_of(Effector effector) noexcept;

struct BodyTarget {
    Effector effector = Effector::LeftHand;
    glm::dvec3 position{0.0};  ///< position of the bone's joint, metres, in the character's space
    /// The bone's rotation in the character's space; blended in by `weight` (up to 1) and clamped to the
    /// joint's limit. Without one a foot keeps the clip's rotation, so that it stays level, and a hand or the
    /// head turns with its parent bone.
    std::optional<glm::dquat> rotation{};
    double weight = 1.0;  ///< 0 to 1e3, relative to other targets; 0: ignored
    bool operator==(const BodyTarget&) const = default;
};

/// The shift of a foot without a target from its place in the clip, as footsteps.hpp sets it.
struct FootShift {
    glm::dvec3 stand{0.0};  ///< metres
    double lift = 0.0;      ///< metres above that; for balance the foot still counts as standing
    bool operator==(const FootShift&) const = default;
};

struct BodyOptions {
    int max_iterations = 20;  ///< 1 to 1000
    /// A smaller step ends the solve: radians (for the hips metres of a figure of 1.8 m), over 0 to 1.
    double tolerance = 2e-6;
    bool feet_stay = true;  ///< feet without a target stay where the clip has them
    /// Fraction of a hand's twist that the lower arm takes, 0 to 1. Twist nodes (twist.hpp) then spread it
    /// along the arm.
    double twist_share = 0.5;
    bool self_collision = true;  ///< keep apart the capsules passed to Body::make
    /// Lets the pose relax towards the clip as if the targets had moved this far, metres, 0 to 1. For the
    /// frames after a target is released; without it the rest of the body would stay pulled.
    double settle = 0.0;
    /// Keeps the centre of mass (balance.hpp) over the standing feet: hips and trunk move so that it stays in
    /// the support, while the targets are reached as closely as that allows. Arms without a target do not act
    /// as counterweights. The pose may be as far out of balance as the clip. No effect if find_soles()
    /// refuses the legs.
    bool balance = false;
    /// Fraction of the support, from edge to middle, that the centre of mass keeps clear of: 0 to 0.9.
    double reserve = 0.25;
    std::array<FootShift, 2> feet{};  ///< left, right; only feet that stay
    const Ground* ground =
        nullptr;  ///< decides which feet stand, for balance; null: the lowest sole is on the ground
    bool operator==(const BodyOptions&) const = default;
};

/// The end of the last solve, from which the next one starts. If empty, it starts from the clip's pose.
struct BodyState {
    /// Each bone's rotation from the clip's pose, in its parent bone's frame, in the order of Body::bones().
    std::vector<glm::dquat> turns{};
    glm::dvec3 shift{0.0};                          ///< offset of the hips from the clip's, metres
    std::array<glm::dvec3, effector_count> clip{};  ///< the effectors' positions in the clip, metres
    double deepest = 0.0;                           ///< deepest overlap of two capsules, metres
    std::array<glm::dvec3, effector_count> left{};  ///< from each effector to its target, metres
    std::array<double, effector_count> weights{};   ///< weights of the targets; 0: no target
    double outside = 0.0;                           ///< BodyReport::outside
    double pace = 0.0;                              ///< limit on a joint's movement in that solve, metres
    bool operator==(const BodyState&) const = default;
};

struct BodyReport {
    int iterations = 0;
    bool settled = true;                             ///< false: stopped by max_iterations or the speed limit
    double residual = 0.0;                           ///< metres, the largest
    std::array<double, effector_count> residuals{};  ///< metres; 0: no target
    std::array<bool, bone_count> at_limit{};         ///< joints stopped by their limits
    double penetration = 0.0;                        ///< deepest overlap of two capsules, metres
    /// Metres by which the centre of mass leaves the safe part of the support although `balance` is on,
    /// beyond the clip's own distance. Small but over 0 while targets hold it there.
    double outside = 0.0;
};

namespace detail {
class BodySolve;
class HoldSolve;
}  // namespace detail

class Body {
  public:
    /// Refuses an unusable map, bones that do not descend from the hips, and invalid limits or capsules.
    /// `capsules`: hands and lower arms are kept out of trunk, head, legs and the other arm, and lower legs
    /// out of each other. Capsules that overlap at rest may overlap as deeply in a pose.
    static Expected<Body> make(const Skeleton& skeleton, const BoneMap& map,
                               const BodyLimits& limits = no_limits(),
                               std::span<const BodyCapsule> capsules = {});
    Body(Body&&) noexcept;
    Body& operator=(Body&&) noexcept;
    ~Body();

    /// The mapped bones, parents first.
    const std::vector<Bone>& bones() const noexcept;
    const BodyJoints& joints() const noexcept;

    /// `pose` holds the clip's local transform of every node and is replaced by the pose that reaches the
    /// targets. Without a target, a shifted foot or capsules to keep apart, it stays bit-identical and
    /// `state` is cleared. If the clip exceeds a joint's limit, that limit is widened to the clip. Fails with
    /// InvalidArgument, changing nothing: a number not finite or out of range, two targets of one effector, a
    /// pose without one transform per node, a state of another body, a pose without a finite solution.
    /// Allocates nothing once `state` has been used.
    Expected<BodyReport> solve(std::span<rig::Transform> pose, std::span<const BodyTarget> targets,
                               BodyState& state, const BodyOptions& options = {});

  private:
    struct Work;  // precomputed data and scratch
    friend class detail::BodySolve;
    friend class detail::HoldSolve;
    explicit Body(std::unique_ptr<Work> work) noexcept;
    static void find_tips(Work& work, const Skeleton& skeleton);
    std::unique_ptr<Work> work_;
};

}  // namespace tendril::humanoid

template <>
std::span<const tendril::Field>
tendril::fields<tendril::humanoid::BodyTarget>() noexcept;  ///< not its effector
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::FootShift>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::BodyOptions>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::BodyState>() noexcept;
