#include "tendril/humanoid/hands.hpp"

#include <cmath>

#include "humanoid/input.hpp"
#include "humanoid/view.hpp"
#include "rig/checks.hpp"
#include "tendril/humanoid/twist.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;
using detail::Limb;
using detail::LimbPlacement;
using tendril::detail::refused;

constexpr Bone arms[2][4]{{Bone::LeftShoulder, Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand},
                          {Bone::RightShoulder, Bone::RightUpperArm, Bone::RightLowerArm, Bone::RightHand}};
constexpr double zero_weight = 0.01;
/// The arm's maximum reach in arm lengths: a millimetre short, since a straight elbow has no side.
constexpr double straightest = 0.998;

struct Arm {
    Limb limb{};
    std::ptrdiff_t shoulder = -1;          // index in the limb's path; -1: none
    glm::dvec3 direction{0.0}, pole{0.0};  // at rest: from shoulder to hand; where the elbow points
};

Result check(const HandTargets& targets, std::size_t i) noexcept {
    const tendril::detail::Argument at{"targets", i, "position"}, turn{"targets", i, "rotation"};
    if (const Result bad = rig::detail::check_vector("step", at, targets[i].position); !bad) return bad;
    if (!targets[i].rotation) return {};
    const double size = dot(*targets[i].rotation, *targets[i].rotation);
    if (size > 1e-6 && size < 1e6) return {};
    return refused("step", turn, "a rotation of length 1e-3 to 1e3", "one that is not");
}

/// Turns the shoulder towards a target beyond the arm's reach, by at most `most` radians, and updates `at`.
/// Returns the shoulder's turn.
glm::dquat shrug(const Arm& arm, const Placement& root, detail::Pose pose, LimbPlacement& at,
                 const glm::dvec3& target, double longest, double most) noexcept {
    const glm::dquat none{1.0, 0.0, 0.0, 0.0};
    if (arm.shoulder < 0 || length(minus(target, at.upper.position)) <= longest) return none;
    Placement above = root;
    for (std::size_t i = 0; i < static_cast<std::size_t>(arm.shoulder); ++i)
        above = above * placement(pose[arm.limb.node(i)]);
    rig::Transform& local = pose[arm.limb.node(static_cast<std::size_t>(arm.shoulder))];
    const Placement shoulder = above * placement(local);

    // In the triangle of shoulder, arm's root and target: the angle at the shoulder at which the arm reaches.
    const glm::dvec3 bone = minus(at.upper.position, shoulder.position),
                     way = minus(target, shoulder.position);
    const double c = length(bone), d = length(way);
    const auto axis = direction_of(cross(bone, way), 1e-9 * c * d + 1e-12);
    if (!(c > 1e-6 && d > 1e-6) || !axis) return none;
    const double cosine = std::clamp((c * c + d * d - longest * longest) / (2.0 * c * d), -1.0, 1.0);
    const double wanted = arctangent(std::sqrt(1.0 - cosine * cosine), cosine);
    const double angle = std::clamp(detail::angle_between(bone, way) - wanted, 0.0, most);
    const glm::dquat by = rotation_about(*axis, angle);
    detail::turn(local, above, by);
    at = detail::place(arm.limb, root, pose);
    return by;
}

/// Maximum straightness of the arm. An arm that is straighter in the clip bends as the weight grows.
double straightest_of(const LimbPlacement& at, double weight) noexcept {
    const double full = at.upper_length() + at.lower_length();
    const double clip = length(minus(at.end.position, at.upper.position)) / std::max(full, 1e-9);
    const double over = std::clamp(clip, straightest, 1.0) - straightest;
    return straightest + over * std::max(0.0, 1.0 - 5.0 * weight);
}

/// The elbow's pole for a straight arm: the pole at rest, turned with the body and the arm.
glm::dvec3 pole_of(const Arm& arm, const LimbPlacement& at, const glm::dquat& body) noexcept {
    const glm::dvec3 rest = rotated(body, arm.direction);
    const auto now = direction_of(minus(at.end.position, at.upper.position), 1e-9);
    return rotated(minimal_rotation(rest, now.value_or(rest)), rotated(body, arm.pole));
}

}  // namespace

struct Hands::Plan {
    std::size_t nodes = 0;
    detail::Head head{};
    std::size_t hips = 0;  // index in the head's path
    glm::dquat hips_at_rest{1.0, 0.0, 0.0, 0.0};
    std::array<Arm, 2> arms{};
    TwistNodes twist{};

    HandReport move(const Arm& arm, detail::Pose pose, const HandTarget& target, double weight,
                    const Placement& root, const HandsOptions& options) const noexcept {
        LimbPlacement at = detail::place(arm.limb, root, pose);
        if (weight > 0.0) {
            Placement body = root;
            for (std::size_t i = 0; i <= hips; ++i)
                body = body * placement(pose[static_cast<std::size_t>(head.path[i])]);
            const glm::dquat turned = math::compose(body.rotation(), conjugate(hips_at_rest));
            const glm::dvec3 goal = mix(at.end.position, target.position, weight);
            const glm::dquat was = at.end.rotation();
            const double straight = straightest_of(at, weight),
                         longest = detail::reach_of(at, straight).longest;
            const glm::dquat shrugged = shrug(arm, root, pose, at, goal, longest, options.shoulder);
            // Clips may have elbows in any direction: the pole counts only for a straight arm, and fades in.
            const detail::Pole pole{.direction = pole_of(arm, at, turned),
                                    .part = 0.01 * std::min(1.0, 10.0 * weight),
                                    .always = false};
            const detail::Bend bend = detail::bend_to(at, goal, pole, straight);
            glm::dquat end = bend.lower;
            if (target.rotation) {
                const glm::dquat whole = math::compose(rig::normalised(*target.rotation), conjugate(was));
                end = math::compose(slerp({1.0, 0.0, 0.0, 0.0}, whole, weight), conjugate(shrugged));
            }
            detail::apply(bend, end, arm.limb, at, pose);
        }
        return {.weight = weight,
                .residual = length(minus(at.end.position, target.position)),
                .position = at.end.position};
    }
};

Result check(const HandsOptions& options) noexcept {
    constexpr const char* operation = "hands";
    if (const Result bad = check_fields(operation, options); !bad) return bad;
    const Expected<rig::Transform> root = rig::checked(options.root, operation, "root");
    return root ? Result() : root.error();
}

Expected<signal::Curve> weight_curve(double begin, double full, double until, double end) {
    signal::Curve curve;
    curve.keys.clear();
    for (const auto& [time, value] : {std::pair(begin, 0.0), {full, 1.0}, {until, 1.0}, {end, 0.0}}) {
        if (!curve.keys.empty() && time == curve.keys.back().time && value == curve.keys.back().value)
            continue;
        curve.keys.push_back({.time = time, .value = value, .piece = signal::Piece::Cubic});
    }
    if (const Result bad = check(curve); !bad) return bad;
    return curve;
}

Hands::Hands(std::unique_ptr<Plan> plan) noexcept : plan_(std::move(plan)) {}
Hands::~Hands() = default;
Hands::Hands(Hands&&) noexcept = default;
Hands& Hands::operator=(Hands&&) noexcept = default;

Expected<Hands> Hands::make(const Skeleton& skeleton, const BoneMap& map) {
    const Expected<Soles> soles = find_soles(skeleton, map);
    if (!soles) return soles.error();
    if (const Result bad = detail::check_usable("Hands", map); !bad) return bad;
    auto plan = std::make_unique<Plan>();
    plan->nodes = skeleton.size();
    plan->head = detail::Head::make(skeleton, map, soles->forward);
    const auto hips = std::find(plan->head.path.begin(), plan->head.path.end(), map[Bone::Hips].node);
    if (hips == plan->head.path.end())
        return refused("Hands", name(Bone::Head), "below the hips", map[Bone::Head].node);
    plan->hips = static_cast<std::size_t>(hips - plan->head.path.begin());

    std::vector<Placement> rest(skeleton.size());
    place(skeleton, rest_pose(skeleton), rest);
    plan->hips_at_rest = rest[static_cast<std::size_t>(*hips)].rotation();
    for (std::size_t i = 0; i < 2; ++i) {
        const auto node = [&](int bone) { return map[arms[i][bone]].node; };
        auto limb = Limb::make(skeleton, node(1), node(2), node(3), node(3));
        const auto other = static_cast<std::size_t>(map[mirrored(arms[i][3])].node);
        if (!limb || skeleton.is_below(other, static_cast<std::size_t>(node(1))))
            return refused("Hands", name(arms[i][1]), "above its own forearm and hand, and no other hand",
                           std::string_view(skeleton[static_cast<std::size_t>(node(1))].name));
        const auto position = [&](int bone) { return rest[static_cast<std::size_t>(node(bone))].position; };
        Arm& arm = plan->arms[i];
        const auto line = direction_of(minus(position(3), position(1)), 1e-6);
        if (!line || !(length(minus(position(2), position(1))) > 1e-6 &&
                       length(minus(position(3), position(2))) > 1e-6))
            return refused("Hands", name(arms[i][1]), "the start of an arm whose bones have a length", 0.0);
        arm.direction = *line;
        // Elbows point backwards, or in an arbitrary direction if the arm itself points backwards.
        arm.pole =
            direction_of(across(times(soles->forward, -1.0), *line), 1e-6).value_or(perpendicular(*line));
        const auto shoulder = std::find(limb->path.begin(), limb->path.end(), node(0));
        const bool has_shoulder = node(0) >= 0 &&
                                  shoulder - limb->path.begin() < std::ptrdiff_t(limb->upper) &&
                                  !skeleton.is_below(other, static_cast<std::size_t>(node(0)));
        if (has_shoulder) arm.shoulder = shoulder - limb->path.begin();
        arm.limb = std::move(*limb);
    }
    plan->twist = TwistNodes::find(skeleton, map);
    return Hands(std::move(plan));
}

HandsReport Hands::step(std::span<rig::Transform> pose, const HandTargets& targets, double dt,
                        HandsState& state, const HandsOptions& options) const noexcept {
    if (!plan_) return {.accepted = tendril::detail::moved_from("step", "hands")};
    const Plan& plan = *plan_;
    if (const Result bad = detail::check_pose("step", pose, plan.nodes); !bad) return {.accepted = bad};
    if (const Result bad = check(options); !bad) return {.accepted = bad};
    const Placement root = placement(options.root);
    const Placement head = plan.head.place_in(root, pose);
    for (std::size_t i = 0; i < 2; ++i) {
        if (const Result bad = check(targets, i); !bad) return {.accepted = bad};
        if (!detail::place(plan.arms[i].limb, root, pose).is_finite())
            return {.accepted = detail::refused_bones("step")};
    }
    if (!detail::is_moderate(head)) return {.accepted = detail::refused_bones("step")};

    HandsReport report;
    const TwistNodes::ArmTurns before = plan.twist.turns(pose);
    const glm::dvec3 gaze = plan.head.gaze(head);
    for (std::size_t i = 0; i < 2; ++i) {
        const HandTarget& target = targets[i];
        HandState& hand = state.hands[i];
        const double angle = detail::angle_between(gaze, minus(target.position, head.position));
        const double seen =
            detail::step_view(hand.in_view, hand.view, angle, options.view, options.half_life, dt);
        const double wanted = rig::detail::weight(target.weight) * seen;
        const double part = wanted < zero_weight ? 0.0 : (wanted - zero_weight) / (1.0 - zero_weight);
        report.hands[i] = plan.move(plan.arms[i], pose, target, part, root, options);
        report.hands[i].in_view = hand.in_view;
    }
    plan.twist.follow(before, pose);
    return report;
}

}  // namespace tendril::humanoid
