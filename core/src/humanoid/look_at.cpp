#include "tendril/humanoid/look_at.hpp"

#include "humanoid/input.hpp"
#include "humanoid/view.hpp"
#include "rig/checks.hpp"
#include "tendril/rig/aim.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;
using tendril::detail::refused;

constexpr Bone column[]{Bone::Spine, Bone::Chest, Bone::UpperChest, Bone::Neck, Bone::Head};
constexpr std::size_t neck = 3, head = 4;
constexpr glm::dquat none{1.0, 0.0, 0.0, 0.0};

/// A bone that turns: its indices in the head's path and in `column`.
struct TurnedBone {
    std::size_t place = 0, bone = 0;
};

double limited(double angle, double most) noexcept {
    return std::min(angle, most);
}

/// The gaze's next direction on its way to `target`. It goes through the clip's gaze, `ahead`, if the
/// shortest arc would change sides behind the head, outside the view, where all bones would turn over.
glm::dvec3 next_gaze(const glm::dvec3& gaze, const glm::dvec3& target, const glm::dvec3& ahead,
                     double view) noexcept {
    const bool same_side = dot(gaze, target) >= dot(gaze, ahead) * dot(target, ahead);
    if (same_side) return target;
    const auto middle = direction_of(plus(gaze, target), 1e-6);
    return middle && detail::angle_between(*middle, ahead) <= view ? target : ahead;
}

}  // namespace

struct LookAt::Plan {
    std::size_t nodes = 0;
    detail::Head head{};
    std::vector<TurnedBone> bones{};  // from the spine up; the last one is the head
    std::size_t spine_bones = 0;

    double limit_of(std::size_t bone, const LookAtOptions& options) const noexcept {
        if (bone == ::tendril::humanoid::head) return options.head_limit;
        return bone == neck ? options.neck_limit : options.spine_limit / static_cast<double>(spine_bones);
    }
    double part_of(std::size_t bone, const LookAtOptions& options) const noexcept {
        if (bone == ::tendril::humanoid::head) return 1.0;
        return bone == neck ? options.neck_part : options.spine_part / static_cast<double>(spine_bones);
    }

    /// The placement of the parent of the path's node at index `place`.
    Placement above(std::size_t place, const Placement& root, detail::Pose pose) const noexcept {
        Placement at = root;
        for (std::size_t i = 0; i < place; ++i)
            at = at * placement(pose[static_cast<std::size_t>(head.path[i])]);
        return at;
    }

    void turn(detail::Pose pose, const Placement& root, const glm::dvec3& point, double weight,
              const LookAtOptions& options) const noexcept;
};

/// Turns each bone as if the head's gaze were fixed to it, by its share of the remaining turn.
void LookAt::Plan::turn(detail::Pose pose, const Placement& root, const glm::dvec3& point, double weight,
                        const LookAtOptions& options) const noexcept {
    double left = 1.0;
    for (const TurnedBone& each : bones) {
        const Placement parent = above(each.place, root, pose);
        const auto node = static_cast<std::size_t>(head.path[each.place]);
        const glm::dquat rotation = (parent * placement(pose[node])).rotation();
        const Placement eyes = head.place_in(root, pose);
        const glm::dvec3 ahead = head.gaze(eyes);
        const glm::dvec3 gaze = direction_of(minus(point, eyes.position), 1e-6).value_or(ahead);
        const double part = each.bone == ::tendril::humanoid::head
                                ? 1.0
                                : limited(part_of(each.bone, options) / std::max(left, 1e-9), 1.0);
        left -= part_of(each.bone, options);

        rig::AimOptions aim;
        aim.primary.axis = rotated(conjugate(rotation), ahead);
        aim.primary.target = detail::turned_toward(ahead, gaze, part * detail::angle_between(ahead, gaze));
        aim.primary.kind = rig::AimTarget::Direction;
        const glm::dquat aimed = rig::aim({.rotation = rotation}, aim).transform.rotation;
        const glm::dquat whole = math::compose(aimed, conjugate(rotation));
        const double angle = 2.0 * half_angle_between(none, whole);
        const double most = limited(angle, limit_of(each.bone, options));
        if (!(angle > 1e-12)) continue;
        detail::turn(pose[node], parent, slerp(none, whole, weight * most / angle));
    }
}

Result check(const LookAtOptions& options) noexcept {
    constexpr const char* operation = "look_at";
    if (const Result bad = check_fields(operation, options); !bad) return bad;
    if (options.spine_part + options.neck_part > 1.0)
        return refused(operation, "neck_part", "at most 1 together with spine_part", options.neck_part);
    const Expected<rig::Transform> root = rig::checked(options.root, operation, "root");
    return root ? Result() : root.error();
}

LookAt::LookAt(std::unique_ptr<Plan> plan) noexcept : plan_(std::move(plan)) {}
LookAt::~LookAt() = default;
LookAt::LookAt(LookAt&&) noexcept = default;
LookAt& LookAt::operator=(LookAt&&) noexcept = default;

Expected<LookAt> LookAt::make(const Skeleton& skeleton, const BoneMap& map) {
    const Expected<Soles> soles = find_soles(skeleton, map);
    if (!soles) return soles.error();
    if (const Result bad = detail::check_usable("LookAt", map); !bad) return bad;
    auto plan = std::make_unique<Plan>();
    plan->nodes = skeleton.size();
    plan->head = detail::Head::make(skeleton, map, soles->forward);
    const std::vector<std::int32_t>& path = plan->head.path;
    for (std::size_t i = 0; i < std::size(column); ++i) {
        const auto at = std::find(path.begin(), path.end(), map[column[i]].node);
        if (map[column[i]].node < 0) continue;
        const auto place = static_cast<std::size_t>(at - path.begin());
        if (at == path.end() || (!plan->bones.empty() && place <= plan->bones.back().place))
            return refused("LookAt", name(column[i]), "between the bones before it and the head",
                           std::string_view(skeleton[static_cast<std::size_t>(map[column[i]].node)].name));
        plan->bones.push_back({place, i});
        plan->spine_bones += i < neck;
    }
    return LookAt(std::move(plan));
}

LookAtReport LookAt::step(std::span<rig::Transform> pose, const LookAtOptions& options, double dt,
                          LookAtState& state) const noexcept {
    if (!plan_) return {.accepted = tendril::detail::moved_from("step", "look_at")};
    const Plan& plan = *plan_;
    if (const Result bad = detail::check_pose("step", pose, plan.nodes); !bad) return {.accepted = bad};
    if (const Result bad = check(options); !bad) return {.accepted = bad};
    const Placement root = placement(options.root);
    const Placement at = plan.head.place_in(root, pose);
    if (!detail::is_moderate(at)) return {.accepted = detail::refused_bones("step")};

    const glm::dvec3 ahead = plan.head.gaze(at), way = minus(options.target, at.position);
    const glm::dvec3 target = direction_of(way, 1e-6).value_or(ahead);
    const double seen = detail::step_view(state.in_view, state.view, detail::angle_between(ahead, target),
                                          options.view, options.half_life, dt);
    const bool is_first = dot(state.gaze, state.gaze) < 0.5;
    const double most = dt > 0.0 ? options.max_speed * std::min(dt, 1e3) : 0.0;
    // The gaze does not track a target out of view. When one comes into view, it starts from the clip's gaze.
    const glm::dvec3 from = seen > 0.0 ? state.gaze : ahead;
    const glm::dvec3 to = state.in_view ? next_gaze(from, target, ahead, options.view) : from;
    state.gaze = is_first ? target : detail::turned_toward(from, to, most);

    LookAtReport report{.weight = rig::detail::weight(options.weight) * seen, .in_view = state.in_view};
    const glm::dvec3 point = plus(at.position, times(state.gaze, length(way)));
    if (report.weight > 0.0) plan.turn(pose, root, point, report.weight, options);
    const Placement now = plan.head.place_in(root, pose);
    const auto to_target = direction_of(minus(options.target, now.position), 1e-6);
    report.left = to_target ? detail::angle_between(plan.head.gaze(now), *to_target) : 0.0;
    return report;
}

}  // namespace tendril::humanoid
