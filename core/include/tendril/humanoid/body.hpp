// A whole body that reaches: hands, feet, head and hips for their targets at once, from the pose that a clip
// gives and within the limits of its joints.
//
//     Expected<Body> body = Body::make(skeleton, map, default_limits(skeleton, map));
//     BodyState state;  // beside the document: where the last solve ended
//     sample(clip, skeleton, seconds, pose);
//     const Expected<BodyReport> report = body->solve(pose, targets, state);
//
// Of all poses that bring the effectors to their targets the solver looks for one that turns the bones little
// from the clip's, each weighed by how readily it turns: a hand is fetched by the arm before the spine helps,
// and the spine before the hips. Where targets disagree the residual is shared by weight, as least squares
// do. Feet without a target stay where the clip has them; a hand or the head without one goes with the body,
// and keeps the clip's pose.
//
// Method: damped least squares over the turns of all bones (Levenberg 1944, Marquardt 1963), damped by what
// is left of the way (T. Sugihara, "Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt
// method", IEEE Transactions on Robotics 27(5), 2011), with the turn back to the clip's pose in the null
// space (A. Liegeois, "Automatic supervisory control of the configuration and behavior of multibody
// mechanisms", 1977). Its equations have a row for each coordinate of a target, not a column for each turn. A
// joint at its limit loses the direction that leads out of it (active set).
//
// Near its full length a limb would have to bend infinitely fast for a target that comes nearer evenly. There
// the solver takes the bend for a little more than it is, and stops up to 0.7 mm (of 1.8 m) short: elbows and
// knees then move at most some 13 times as fast as the target.
//
// Not FABRIK over layers of chains: that finds positions and makes rotations of them afterwards, loses the
// twist on the way, and has to be told of limits in every pass.
//
// Cost: an iteration of 22 bones and 5 targets takes 2 to 3 microseconds; a target that moves by a millimetre
// takes some 5 to 10. tests/bench/humanoid_body.cpp measures it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tendril/humanoid/capsules.hpp"
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
    glm::dvec3 position{0.0};  ///< metres, of the bone's joint, in the character's space
    /// Of the bone, in the character's space; taken as far as `weight` (up to 1) and its limit. Without one a
    /// foot keeps the clip's, so that it stays level, and a hand or the head goes along with the bone before.
    std::optional<glm::dquat> rotation{};
    double weight = 1.0;  ///< 0 to 1e3, against other targets; 0 is no target
};

struct BodyOptions {
    int max_iterations = 20;  ///< 1 to 1000
    double tolerance = 2e-6;  ///< radians (and metres, of the hips): a step under it is the last. Over 0
    bool feet_stay = true;    ///< feet without a target stay where the clip has them
    /// Of a hand's twist, taken by the lower arm: 0 to 1. Twist nodes (twist.hpp) then spread it along the
    /// arm.
    double twist_share = 0.5;
    bool self_collision = true;  ///< the capsules that the body was made with are kept apart
    /// Metres: lets the pose relax towards the clip as far as if the targets had moved by that much. For the
    /// frames after a target was let go, whose pull the rest of the body would keep otherwise. 0 to 1.
    double settle = 0.0;
};

/// Where the last solve ended, for the next one to start from. A value; empty: at the clip's pose.
struct BodyState {
    /// Of each bone of the body in the order of Body::bones(), from the clip's pose, in the frame of the bone
    /// before.
    std::vector<glm::dquat> turns{};
    glm::dvec3 shift{0.0};                          ///< of the hips from the clip's, metres
    std::array<glm::dvec3, effector_count> clip{};  ///< where the clip had the effectors, metres
    double deepest = 0.0;                           ///< metres that capsules were in each other
    std::array<glm::dvec3, effector_count> left{};  ///< of the way to each target, metres
    std::array<double, effector_count> weights{};   ///< of the targets, 0 of those without one
    double pace = 0.0;                              ///< metres that a joint might move in that solve
    bool operator==(const BodyState&) const = default;
};

struct BodyReport {
    int iterations = 0;
    bool settled = true;                             ///< false: max_iterations came first
    double residual = 0.0;                           ///< metres, the largest
    std::array<double, effector_count> residuals{};  ///< metres; 0 of those without a target
    std::array<bool, bone_count> at_limit{};         ///< joints that their limits hold back now
    double penetration = 0.0;                        ///< metres that capsules are in each other, at most
};

namespace detail {
class BodySolve;
}

class Body {
  public:
    /// Refuses a map that is not usable, one whose bones do not hang on each other as a body's do, and limits
    /// with a fault. Of `capsules`, hands and lower arms are kept out of trunk, head, legs and the other arm,
    /// and lower legs out of each other, as far as they are so at rest; without any, nothing is.
    static Expected<Body> make(const Skeleton& skeleton, const BoneMap& map,
                               const BodyLimits& limits = no_limits(),
                               std::span<const BodyCapsule> capsules = {});
    Body(Body&&) noexcept;
    Body& operator=(Body&&) noexcept;
    ~Body();

    /// The bones that turn, each after the one that it hangs on.
    const std::vector<Bone>& bones() const noexcept;
    const BodyJoints& joints() const noexcept;

    /// `pose` is the clip's, local to the parents, of all nodes; it is turned into the one that reaches.
    /// Without a target it stays as it is, to the bit, and the state is emptied. Where the clip itself
    /// exceeds a limit, that joint's limit reaches as far as the clip. InvalidArgument, and nothing is moved:
    /// a number that is not finite or out of its range, two targets of one effector, a list that has not a
    /// transform for each node, a state of another body, a pose of which no finite one can be made. Allocates
    /// nothing once `state` has been used.
    Expected<BodyReport> solve(std::span<rig::Transform> pose, std::span<const BodyTarget> targets,
                               BodyState& state, const BodyOptions& options = {});

  private:
    struct Work;  // the body made ready, and scratch
    friend class detail::BodySolve;
    explicit Body(std::unique_ptr<Work> work) noexcept;
    static void find_tips(Work& work, const Skeleton& skeleton);
    std::unique_ptr<Work> work_;
};

}  // namespace tendril::humanoid
