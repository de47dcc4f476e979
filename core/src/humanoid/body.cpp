#include "tendril/humanoid/body.hpp"

#include <algorithm>
#include <cmath>

#include "humanoid/body_solve.hpp"
#include "humanoid/input.hpp"
#include "humanoid/limb.hpp"
#include "rig/checks.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;
using detail::Link;

constexpr const char* effector_names[]{"hips", "head", "left_hand", "right_hand", "left_foot", "right_foot"};

/// Mobility of a bone, relative to an upper arm.
double mobility_of(Bone bone) noexcept {
    switch (bone) {
        case Bone::Hips:
            return 0.005;
        case Bone::Spine:
        case Bone::Chest:
        case Bone::UpperChest:
            return 0.012;
        case Bone::LeftShoulder:
        case Bone::RightShoulder:
            return 0.03;
        case Bone::Neck:
            return 0.3;
        default:
            return 1.0;
    }
}

/// Fraction of its full length by which a limb may stop short: 0.7 mm for a leg of 0.85 m.
constexpr double slack_part = 0.0008;

/// The link of a bone; -1: the body lacks the bone.
int link_of(const std::vector<Bone>& bones, Bone bone) noexcept {
    const auto found = std::find(bones.begin(), bones.end(), bone);
    return found == bones.end() ? -1 : static_cast<int>(found - bones.begin());
}

Result check_targets(std::span<const BodyTarget> targets) noexcept {
    unsigned seen = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const BodyTarget& target = targets[i];
        const auto index = static_cast<std::size_t>(target.effector);
        if (index >= effector_count)
            return refused("Body::solve", Argument("targets", i, "effector"), "one of the six effectors",
                           static_cast<int>(index));
        if (seen >> index & 1u)
            return refused("Body::solve", Argument("targets", i, "effector"), "listed only once",
                           effector_names[index]);
        seen |= 1u << index;
        char place[] = "targets[0]";
        place[8] = static_cast<char>('0' + i);  // each effector occurs once, so at most 6
        if (const Result bad = check_fields("Body::solve", target, place); !bad) return bad;
    }
    return {};
}

Result check_state(const BodyState& state, std::size_t links) noexcept {
    if (state.turns.empty()) return {};
    if (state.turns.size() != links)
        return tendril::detail::refused_count("Body::solve", "state.turns", state.turns.size(), links);
    return check_fields("Body::solve", state, "state");
}

}  // namespace

const char* name(Effector effector) noexcept {
    return effector_names[static_cast<std::size_t>(effector)];
}

std::optional<Effector> effector_named(std::string_view name) noexcept {
    for (std::size_t i = 0; i < effector_count; ++i)
        if (name == effector_names[i]) return static_cast<Effector>(i);
    return std::nullopt;
}

Bone bone_of(Effector effector) noexcept {
    constexpr Bone bones[]{Bone::Hips,      Bone::Head,     Bone::LeftHand,
                           Bone::RightHand, Bone::LeftFoot, Bone::RightFoot};
    return bones[static_cast<std::size_t>(effector)];
}

Body::Body(std::unique_ptr<Work> work) noexcept : work_(std::move(work)) {}
Body::Body(Body&&) noexcept = default;
Body& Body::operator=(Body&&) noexcept = default;
Body::~Body() = default;

const std::vector<Bone>& Body::bones() const noexcept {
    return tendril::detail::held_or_empty(work_, &Work::bones);
}
const BodyJoints& Body::joints() const noexcept {
    return tendril::detail::held_or_empty(work_, &Work::joints);
}

Expected<Body> Body::make(const Skeleton& skeleton, const BoneMap& map, const BodyLimits& limits,
                          std::span<const BodyCapsule> capsules) {
    if (const Result bad = detail::check_map("Body", map, skeleton); !bad) return bad;
    if (const Result bad = detail::check_usable("Body", map); !bad) return bad;
    Expected<BodyJoints> joints = BodyJoints::make(skeleton, map, limits);
    if (!joints) return joints.error();
    auto work = std::make_unique<Work>();
    work->joints = std::move(*joints);
    std::vector<char> needed(skeleton.size(), 0);
    for (const BoneMatch& match : map.bones)
        for (std::int32_t node = match.node; node >= 0;
             node = skeleton[static_cast<std::size_t>(node)].parent)
            needed[static_cast<std::size_t>(node)] = 1;
    for (const std::int32_t each : skeleton.order()) {
        const auto node = static_cast<std::size_t>(each);
        if (!needed[node]) continue;
        work->needed.push_back(node);
        const auto bone = detail::bone_of(map, each);
        if (!bone) continue;
        const auto before = work->joints.parent(*bone);
        const int parent = before ? link_of(work->bones, *before) : -1;
        if ((parent < 0) != (*bone == Bone::Hips)) return detail::not_below_hips(skeleton, node, *bone);
        Link link{};
        const ik::Limit& limit = work->joints.limit(*bone);
        link.bone = *bone, link.node = node, link.parent = parent;
        link.mobility = mobility_of(*bone) * (1.0 - static_cast<double>(limit.stiffness));
        link.rest = work->joints.rest_rotation(*bone);
        link.base_limit = ik::detail::solvable_joint(limit, math::narrow(work->joints.direction(*bone)));
        if (limit.kind == ik::JointKind::Hinge) link.hinge = math::wide(link.base_limit.axis);
        work->links.push_back(link);
        work->bones.push_back(*bone);
    }
    for (std::size_t i = 0; i < effector_count; ++i) {
        work->ends[i] = link_of(work->bones, humanoid::bone_of(static_cast<Effector>(i)));
        for (int link = work->links[static_cast<std::size_t>(work->ends[i])].parent; link >= 0;
             link = work->links[static_cast<std::size_t>(link)].parent)
            work->links[static_cast<std::size_t>(link)].effectors |= 1u << i;
    }
    const BodyLimits defaults = default_limits(skeleton, map);
    for (const Bone upper :
         {Bone::LeftUpperArm, Bone::RightUpperArm, Bone::LeftUpperLeg, Bone::RightUpperLeg}) {
        const Bone lower = *detail::limb_child(upper), end = *detail::limb_child(lower);
        detail::BodyLimb limb{link_of(work->bones, upper), link_of(work->bones, lower),
                              link_of(work->bones, end)};
        limb.axis = math::wide(defaults[static_cast<std::size_t>(lower)].axis);
        if (work->joints.parent(lower) == upper && work->joints.parent(end) == lower)
            work->limbs.push_back(limb);
    }
    work->parents.reserve(skeleton.size());
    for (const Node& node : skeleton.nodes()) work->parents.push_back(node.parent);
    work->placements.resize(skeleton.size());
    work->saved_turns.resize(work->links.size());
    work->twist = TwistNodes::find(skeleton, map);
    find_tips(*work, skeleton);
    work->size = detail::size_of(map, work->placements);
    if (const Expected<Masses> masses = find_masses(skeleton, map)) {
        work->soles = *find_soles(skeleton, map);
        for (const MassPoint& each : masses->points)
            for (std::size_t i = 0; i < work->links.size(); ++i)
                if (work->links[i].node == each.node) work->masses.push_back({each, static_cast<int>(i)});
    }
    if (const Result bad = work->add_volumes(rest_pose(skeleton), capsules); !bad) return bad;
    work->first.resize(work->links.size() + work->tips.size());
    return Body(std::move(work));
}

void Body::find_tips(Work& work, const Skeleton& skeleton) {
    const std::vector<rig::Transform> rest = rest_pose(skeleton);
    place(skeleton, rest, work.placements);
    for (std::size_t i = 0; i < work.links.size(); ++i) {
        const Link& link = work.links[i];
        const int own = static_cast<int>(i);
        if (std::any_of(work.links.begin(), work.links.end(),
                        [&](const Link& each) { return each.parent == own; }))
            continue;
        glm::dvec3 farthest{0.0};
        for (std::size_t node = 0; node < skeleton.size(); ++node) {
            if (!skeleton.is_below(node, link.node)) continue;
            const glm::dvec3 to = minus(work.placements[node].position, work.placements[link.node].position);
            if (dot(to, to) > dot(farthest, farthest)) farthest = to;
        }
        const glm::dquat turn = math::compose(work.placements[link.node].rotation(), conjugate(link.rest));
        work.tips.push_back({own, rotated(conjugate(turn), farthest)});
    }
}

Expected<BodyReport> Body::solve(std::span<rig::Transform> pose, std::span<const BodyTarget> targets,
                                 BodyState& state, const BodyOptions& options) {
    if (!work_) return tendril::detail::moved_from("Body::solve", "body");
    if (const Result bad = detail::check_pose("Body::solve", pose, work_->parents.size()); !bad) return bad;
    if (const Result bad = check_targets(targets); !bad) return bad;
    if (const Result bad = check_state(state, work_->links.size()); !bad) return bad;
    if (const Result bad = check_fields("Body::solve", options, "options"); !bad) return bad;
    const bool moves_feet = options.feet_stay && options.feet != BodyOptions{}.feet;
    const bool collides = options.self_collision && !work_->pairs.empty();
    if (!collides && !moves_feet && std::none_of(targets.begin(), targets.end(), [](const BodyTarget& each) {
            return each.weight > 0.0;
        })) {
        state = BodyState{};
        return BodyReport{};
    }
    work_->place_needed(pose);
    for (const std::size_t node : work_->needed)
        if (!detail::is_within(work_->placements[node].position))
            return refused("Body::solve", Argument("pose", node), "within 1e9 m of the root",
                           "one farther away");
    const TwistNodes::ArmTurns before = work_->twist.turns(pose);
    const std::optional<BodyReport> report = detail::BodySolve(*work_, targets, options).run(pose, state);
    if (!report)
        return refused("Body::solve", "pose", "of a skeleton with bones of moderate length",
                       "one with extreme lengths");
    work_->twist.follow(before, pose);
    return *report;
}

void Body::Work::place_needed(std::span<const rig::Transform> pose) noexcept {
    for (const std::size_t node : needed) {
        const Placement own = placement(pose[node]);
        placements[node] =
            parents[node] < 0 ? own : placements[static_cast<std::size_t>(parents[node])] * own;
    }
}

void Body::Work::read_pose(std::span<const rig::Transform> pose) noexcept {
    place_needed(pose);
    for (Link& link : links) {
        link.start = math::compose(placements[link.node].rotation(), conjugate(link.rest));
        if (link.parent < 0) {
            link.offset = placements[link.node].position;
            link.clip_turn = link.start;
            continue;
        }
        const Link& before = links[static_cast<std::size_t>(link.parent)];
        const glm::dquat back = conjugate(before.start);
        link.offset = rotated(back, minus(placements[link.node].position, placements[before.node].position));
        link.clip_turn = math::compose(back, link.start);
    }
    const auto own = [&](const Link& link, const glm::dvec3& v) {
        const glm::dmat3& axes = placements[link.node].axes;
        const glm::dvec3 at = plus(plus(times(axes[0], v.x), times(axes[1], v.y)), times(axes[2], v.z));
        return rotated(conjugate(link.start), at);
    };
    for (detail::Volume& volume : volumes) {
        const Link& link = links[static_cast<std::size_t>(volume.link)];
        volume.from = own(link, volume.capsule.from);
        volume.to = own(link, volume.capsule.to);
    }
    for (detail::LinkMass& mass : masses)
        mass.at = own(links[static_cast<std::size_t>(mass.link)], mass.point.at);
    for (detail::BodyLimb& limb : limbs) {
        const double a = length(links[static_cast<std::size_t>(limb.lower)].offset);
        const double b = length(links[static_cast<std::size_t>(limb.end)].offset);
        limb.quadratic = a + b > 0.0 ? 0.5 * a * b / (a + b) : 0.0;
        limb.linear = 2.0 * std::sqrt(limb.quadratic * slack_part * (a + b));  // peaks at the slack
    }
}

Result Body::Work::add_volumes(std::span<const rig::Transform> rest, std::span<const BodyCapsule> capsules) {
    for (std::size_t i = 0; i < capsules.size(); ++i) {
        const BodyCapsule& capsule = capsules[i];
        if (const Result bad = check_vector("Body", "capsules.from", capsule.from); !bad) return bad;
        if (const Result bad = check_vector("Body", "capsules.to", capsule.to); !bad) return bad;
        if (!(capsule.radius >= 0.0 && capsule.radius <= static_cast<double>(max_magnitude)))
            return refused("Body", Argument("capsules", i, "radius"), "from 0 to 1e9 m", capsule.radius);
        const int link = link_of(bones, capsule.bone);
        if (link < 0) return refused("Body", Argument("capsules", i, "bone"), "mapped", name(capsule.bone));
        unsigned moved_by = 0;
        for (int above = link; above >= 0; above = links[static_cast<std::size_t>(above)].parent)
            if (links[static_cast<std::size_t>(above)].effectors != 0) moved_by |= 1u << above;
        volumes.push_back({capsule, link, moved_by});
    }
    read_pose(rest);
    for (Link& link : links) link.turn = link.clip_turn;
    place_links(glm::dvec3(0.0));
    const auto placed = [&](const detail::Volume& volume) {
        const Link& link = links[static_cast<std::size_t>(volume.link)];
        return PlacedCapsule{plus(link.position, rotated(link.rotation, volume.from)),
                             plus(link.position, rotated(link.rotation, volume.to)), volume.capsule.radius};
    };
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        for (std::size_t j = 0; j < volumes.size(); ++j) {
            const Bone bone = volumes[i].capsule.bone, other = volumes[j].capsule.bone;
            if (!detail::may_collide(bone, other) || (detail::may_collide(other, bone) && j < i)) continue;
            const double allowed = gap(placed(volumes[i]), placed(volumes[j]));
            const double radii = volumes[i].capsule.radius + volumes[j].capsule.radius;
            pairs.push_back({i, j, radii + std::min(allowed, 0.0)});
        }
    }
    return {};
}

glm::dvec3 Body::Work::place_of(const detail::Tip& tip) const noexcept {
    const Link& link = links[static_cast<std::size_t>(tip.link)];
    return plus(link.position, rotated(link.rotation, tip.at));
}

void Body::Work::place_links(const glm::dvec3& shift) noexcept {
    for (Link& link : links) {
        if (link.parent < 0) {
            link.position = plus(link.offset, shift);
            link.rotation = link.turn;
            continue;
        }
        const Link& before = links[static_cast<std::size_t>(link.parent)];
        link.position = plus(before.position, rotated(before.rotation, link.offset));
        link.rotation = math::compose(before.rotation, link.turn);
    }
}

void Body::Work::write_pose(std::span<rig::Transform> pose, const glm::dvec3& shift) const noexcept {
    for (const Link& link : links) {
        rig::Transform& local = pose[link.node];
        const glm::dquat was = math::compose(link.start, link.rest);
        glm::dquat turned = math::compose(link.rotation, link.rest);
        if (link.parent >= 0) {  // nodes between two bones turn with the parent bone
            const Link& before = links[static_cast<std::size_t>(link.parent)];
            turned = math::compose(math::compose(before.start, conjugate(before.rotation)), turned);
        }
        // Applied to the clip's local rotation, so that a joint that does not turn stays bit-identical.
        const glm::dquat by = math::compose(conjugate(was), turned);
        if (length(glm::dvec3{by.x, by.y, by.z}) < 1e-14) continue;
        local.rotation = rig::normalised(math::compose(local.rotation, by));
    }
    const Link& hips = links.front();
    if (shift == glm::dvec3(0.0)) return;
    glm::dvec3 own = shift;
    if (const std::int32_t above = parents[hips.node]; above >= 0) {
        const Placement& from = placements[static_cast<std::size_t>(above)];
        own = detail::to_local(from, shift);
    }
    pose[hips.node].translation = plus(pose[hips.node].translation, own);
}

}  // namespace tendril::humanoid
