#include "humanoid/retarget_body.hpp"

#include <algorithm>
#include <cmath>

#include "humanoid/anatomy.hpp"
#include "humanoid/facing.hpp"
#include "humanoid/limb.hpp"
#include "humanoid/names.hpp"

namespace tendril::humanoid::detail {

using namespace rig::detail;

namespace {

struct LegBones {
    Bone upper, lower, foot, toes;
};
constexpr LegBones leg_bones[2]{{Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot, Bone::LeftToes},
                                {Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot, Bone::RightToes}};

constexpr double upright_toes = 0.7;  // rise or fall in toe lengths: over 45 degrees
constexpr double level_feet = 0.01;   // height difference of the feet at rest, in leg lengths

}  // namespace

RetargetBody::RetargetBody(const MappedSkeleton& given) : body(given), at(facing(given.skeleton, given.map)) {
    const Skeleton& skeleton = body.skeleton;
    placed.resize(skeleton.size());
    place(skeleton, rest_pose(skeleton), placed);
    hips = placed[node(Bone::Hips)].position;
    place(skeleton, t_pose(skeleton, body.map), placed);
    for (const Placement& each : placed) rotations.push_back(each.rotation());
    // Forward may be reversed (see Facing); this frame is always right-handed.
    frame = Placement{{cross(at.up, at.forward), at.up, at.forward}, glm::dvec3(0.0)}.rotation();
    find_feet(point_toes());
    for (const bool left : {true, false}) {
        find_fingers(left);
        straighten_hand(left);
        straighten_foot(left);
    }
}

glm::dvec3 RetargetBody::offset(std::size_t from, std::size_t to) const noexcept {
    return minus(placed[to].position, placed[from].position);
}

void RetargetBody::turn(std::size_t node, const glm::dquat& by) {
    const glm::dvec3 pivot = placed[node].position;
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        if (i != node && !body.skeleton.is_below(i, node)) continue;
        rotations[i] = math::compose(by, rotations[i]);
        placed[i].position = plus(pivot, rotated(by, minus(placed[i].position, pivot)));
        for (int axis = 0; axis < 3; ++axis) placed[i].axes[axis] = rotated(by, placed[i].axes[axis]);
    }
}

// ------------------------------------------------------------------------------------------------- hands

void RetargetBody::find_fingers(bool left) {
    const Bone hand = left ? Bone::LeftHand : Bone::RightHand;
    auto& found = fingers[left ? 0 : 1];
    for (FingerNodes& each : found) each.fill(-1);
    if (!has(hand)) return;
    for (const std::int32_t each : body.skeleton.order()) {
        const auto i = static_cast<std::size_t>(each);
        if (i == node(hand) || !body.skeleton.is_below(i, node(hand))) continue;
        const auto finger = finger_named(body.skeleton[i].name);
        if (!finger) continue;
        FingerNodes& nodes = found[static_cast<std::size_t>(*finger)];
        const auto next = std::find(nodes.begin(), nodes.end(), -1);
        if (next == nodes.end()) continue;
        const std::size_t above = next == nodes.begin() ? node(hand) : static_cast<std::size_t>(*(next - 1));
        if (body.skeleton.is_below(i, above)) *next = each;
    }
    std::size_t& last = hands[left ? 0 : 1];
    last = node(hand);
    for (bool goes_on = true; goes_on;) {
        goes_on = false;
        std::size_t next = last;
        for (const std::int32_t child : body.skeleton.children(last)) {
            const auto i = static_cast<std::size_t>(child);
            if (finger_named(body.skeleton[i].name) == Finger::Thumb) continue;
            if (length(offset(last, i)) > shortest()) return;
            if (!goes_on && !body.skeleton.children(i).empty()) next = i, goes_on = true;
        }
        last = next;
    }
}

/// The direction from the wrist to the base of the middle finger; failing that, the mean direction to the
/// other fingers' bases, or to the hand's child nodes.
std::optional<glm::dvec3> RetargetBody::hand_axis(bool left) const {
    const std::size_t hand = node(left ? Bone::LeftHand : Bone::RightHand);
    const auto& own = fingers[left ? 0 : 1];
    const auto base = [&](std::size_t finger) -> std::optional<glm::dvec3> {
        std::optional<glm::dvec3> found;
        // Nodes between the hand and the finger may turn.
        for (std::int32_t node = own[finger][0]; node >= 0 && node != static_cast<std::int32_t>(hand);
             node = body.skeleton[static_cast<std::size_t>(node)].parent)
            if (const auto i = static_cast<std::size_t>(node); !is_palm_name(body.skeleton[i].name))
                if (const auto along = direction_of(offset(hand, i), shortest())) found = along;
        return found;
    };
    if (const auto middle = base(2)) return middle;
    glm::dvec3 sum(0.0);
    for (std::size_t finger = 1; finger < 5; ++finger)
        if (const auto each = base(finger)) sum = plus(sum, *each);
    if (const auto mean = direction_of(sum, 1e-6)) return mean;
    std::vector<std::size_t> open{hand};  // nodes at the wrist
    while (!open.empty()) {
        const std::size_t above = open.back();
        open.pop_back();
        for (const std::int32_t child : body.skeleton.children(above)) {
            const auto i = static_cast<std::size_t>(child);
            if (finger_named(body.skeleton[i].name) == Finger::Thumb) continue;
            if (const auto each = direction_of(offset(hand, i), shortest()))
                sum = plus(sum, *each);
            else
                open.push_back(i);
        }
    }
    return direction_of(sum, 1e-6);
}

void RetargetBody::straighten_hand(bool left) {
    const Bone hand = left ? Bone::LeftHand : Bone::RightHand;
    if (!has(hand)) return;
    const auto axis = hand_axis(left);
    if (!axis) return;
    const glm::dvec3 along = t_direction(hand, at);
    turn(node(hand), minimal_rotation(*axis, along));
    // The thumb keeps its angle to the hand.
    for (std::size_t finger = 1; finger < 5; ++finger) {
        const FingerNodes& own = fingers[left ? 0 : 1][finger];
        for (std::size_t i = 0; i + 1 < own.size() && own[i + 1] >= 0; ++i) {
            const auto from = static_cast<std::size_t>(own[i]), to = static_cast<std::size_t>(own[i + 1]);
            if (const auto bone = direction_of(offset(from, to), 1e-9))
                turn(from, minimal_rotation(*bone, along));
        }
    }
}

std::optional<glm::dquat> RetargetBody::palm_down(bool left) const {
    const Bone hand = left ? Bone::LeftHand : Bone::RightHand;
    if (!has(hand)) return std::nullopt;
    const auto& own = fingers[left ? 0 : 1];
    const auto base = [&](std::size_t finger) {
        return placed[static_cast<std::size_t>(own[finger][0])].position;
    };
    const glm::dvec3 along = t_direction(hand, at);
    if (own[1][0] < 0 || own[4][0] < 0) return std::nullopt;
    const glm::dvec3 thumb_side = minus(base(1), base(4));
    const auto side = direction_of(across(thumb_side, along), shortest());
    if (!side) return std::nullopt;
    const double angle = arctangent(dot(cross(*side, at.forward), along), dot(*side, at.forward));
    return rotation_about(along, angle);
}

// -------------------------------------------------------------------------------------------------- feet

/// Points the toes forward: in some files' zero pose they point up or down.
bool RetargetBody::point_toes() {
    bool turned = false;
    for (const LegBones& bones : leg_bones) {
        if (!has(bones.toes)) continue;
        const std::size_t toes = node(bones.toes);
        const auto along = direction_of(offset(toes, farthest_below(body.skeleton, placed, toes)), 1e-9);
        if (!along || std::abs(dot(*along, at.up)) < upright_toes) continue;
        turn(toes, minimal_rotation(*along, at.forward));
        turned = true;
    }
    return turned;
}

void RetargetBody::find_feet(bool toes_are_turned) {
    double height = 0.0, length_of_both = 0.0;
    has_legs = true;
    for (const LegBones& bones : leg_bones) {
        if (has(bones.foot)) height = std::max(height, offset(node(bones.foot), node(Bone::Hips)).y);
        has_legs = has_legs && has(bones.upper) && has(bones.lower) && has(bones.foot);
        if (has_legs)
            length_of_both += length(offset(node(bones.upper), node(bones.lower))) +
                              length(offset(node(bones.lower), node(bones.foot)));
    }
    leg = has_legs ? 0.5 * length_of_both : height;
    if (!has_legs) return;
    // Finds soles in the rest pose, or in the T-pose if the feet do not stand in the rest pose.
    std::vector<Placement> rest(placed.size());
    place(body.skeleton, rest_pose(body.skeleton), rest);
    const auto stands = [&](const LegBones& bones) {
        return half_angle_between(rest[node(bones.foot)].rotation(), rotations[node(bones.foot)]) < 1e-3;
    };
    std::vector<Node> nodes = body.skeleton.nodes();
    const bool as_it_rests = !toes_are_turned && stands(leg_bones[0]) && stands(leg_bones[1]);
    if (!as_it_rests) {
        for (Node& each : nodes) {
            const auto i = static_cast<std::size_t>(&each - nodes.data());
            each.rest = relative(
                each.parent < 0 ? Placement() : placed[static_cast<std::size_t>(each.parent)], placed[i]);
        }
        rest = placed;
    }
    for (Node& each : nodes) each.keys.reset();
    const auto standing = Skeleton::make(std::move(nodes));
    const auto found = standing ? find_soles(*standing, body.map) : Expected<Soles>(standing.error());
    if (!found) return;
    soles = *found;
    level_soles(rest, as_it_rests);
    // Legs bent at rest are straight in the T-pose, which stands on the same floor.
    double lowest = 1e9;
    for (const Sole& each : soles->feet)
        lowest =
            std::min({lowest, placed[each.foot].apply(each.heel).y, placed[each.toes].apply(each.toe).y});
    hips.y += soles->floor - lowest;
    if (as_it_rests && std::abs(soles->floor) < 0.5 * soles->leg) ground = soles->floor;
    for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t toes = soles->feet[i].toes, tip = farthest_below(body.skeleton, rest, toes);
        const glm::dvec3 ball = rest[toes].apply(soles->feet[i].toe), end = rest[tip].position,
                         ankle = rest[soles->feet[i].foot].position;
        const auto level = [](const glm::dvec3& v) { return std::sqrt(v.x * v.x + v.z * v.z); };
        if (tip != toes && level(minus(end, ankle)) > level(minus(ball, ankle)))
            tips[i] = to_local(rest[toes], minus({end.x, ball.y, end.z}, rest[toes].position));
    }
}

/// If the legs differ in length, both soles are as thick as the thinner one. If the rest pose does not show
/// the thickness, soles end at the lowest joint, as in the lint.
void RetargetBody::level_soles(const std::vector<Placement>& standing, bool shows_thickness) {
    std::array<double, 2> lowest{1e9, 1e9};
    for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t i = 0; i < standing.size(); ++i)
            if (body.skeleton.is_below(i, soles->feet[side].foot))
                lowest[side] = std::min(lowest[side], standing[i].position.y);
    const double both = std::min(lowest[0], lowest[1]);
    if (shows_thickness && std::abs(lowest[0] - lowest[1]) < level_feet * leg) return;
    const double thickness = shows_thickness ? both - soles->floor : 0.0;
    for (std::size_t side = 0; side < 2; ++side) {
        Sole& each = soles->feet[side];
        const glm::dvec3 up{0.0, lowest[side] - thickness - soles->floor, 0.0};
        each.heel = plus(each.heel, to_local(standing[each.foot], up));
        each.toe = plus(each.toe, to_local(standing[each.toes], up));
    }
    soles->floor = both - thickness;
}

SoleTriple RetargetBody::sole(bool left, double above) const {
    const LegBones& bones = leg_bones[left ? 0 : 1];
    const std::size_t foot = node(bones.foot), toes = has(bones.toes) ? node(bones.toes) : foot;
    const glm::dvec3 ankle = placed[foot].position;
    const Sole& own = soles->feet[left ? 0 : 1];
    const glm::dvec3 heel = placed[foot].apply(own.heel), ball = placed[toes].apply(own.toe);
    const auto& end = tips[left ? 0 : 1];
    const auto below = [&](std::size_t its, const glm::dvec3& point) {
        const glm::dvec3 down{point.x, ankle.y - above, point.z};
        return rotated(conjugate(rotations[its]), minus(down, placed[its].position));
    };
    return {below(foot, heel), below(toes, ball), below(toes, end ? placed[toes].apply(*end) : ball)};
}

void RetargetBody::level(std::size_t node, const glm::dvec3& up) {
    turn(node, minimal_rotation(rotated(rotations[node], up), at.up));
}

void RetargetBody::straighten_foot(bool left) {
    const LegBones& bones = leg_bones[left ? 0 : 1];
    if (!has(bones.foot)) return;
    const std::size_t foot = node(bones.foot);
    const std::size_t end = has(bones.toes) ? node(bones.toes) : farthest_below(body.skeleton, placed, foot);
    const glm::dvec3 toes = offset(foot, end);
    const auto level = direction_of(glm::dvec3(toes.x, 0.0, toes.z), 0.02 * leg + 1e-9);
    if (level && dot(*level, at.forward) > 0.5) turn(foot, minimal_rotation(*level, at.forward));
}

}  // namespace tendril::humanoid::detail
