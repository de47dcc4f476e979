// Figures that lie on their side because their file has a different up axis.
#include <algorithm>

#include "humanoid/lint/lint.hpp"

namespace tendril::humanoid::lint_detail {
namespace {

using namespace rig::detail;

/// Unit vectors of one pose: from the hips to the head, and from the feet to the hips.
struct Stance {
    glm::dvec3 torso, legs;
};
std::optional<Stance> stance_of(const BoneMap& map, const std::vector<Placement>& placed) {
    const auto at = [&](Bone bone) { return placed[static_cast<std::size_t>(map[bone].node)].position; };
    for (const Bone bone : {Bone::Hips, Bone::Head, Bone::LeftFoot, Bone::RightFoot})
        if (map[bone].node < 0) return std::nullopt;
    const glm::dvec3 feet = times(plus(at(Bone::LeftFoot), at(Bone::RightFoot)), 0.5);
    const auto torso = direction_of(minus(at(Bone::Head), at(Bone::Hips)), 1e-9);
    const auto legs = direction_of(minus(at(Bone::Hips), feet), 1e-9);
    if (!torso || !legs) return std::nullopt;
    return Stance{*torso, *legs};
}

/// The nearest of the six axis directions.
glm::dvec3 nearest_axis(const glm::dvec3& direction) {
    int best = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(direction[i]) > std::abs(direction[best])) best = i;
    glm::dvec3 axis(0.0);
    axis[best] = direction[best] < 0.0 ? -1.0 : 1.0;
    return axis;
}

/// Some forty poses of a clip, and the left foot's range in them.
struct Poses {
    std::vector<Stance> stances;
    double swing = 0.0;  ///< diagonal of the foot's bounds relative to the hips, metres
    double leg = 0.0;    ///< maximum distance of the foot from the hips, metres
};
std::optional<Poses> poses_of(const Skeleton& skeleton, const BoneMap& map, const Clip& clip) {
    constexpr int count = 40;
    Poses poses;
    std::vector<rig::Transform> pose(skeleton.size());
    std::vector<Placement> placed(skeleton.size());
    glm::dvec3 low(1e9), high(-1e9);
    for (int i = 0; i <= count; ++i) {
        sample(clip, skeleton, clip.duration * i / count, pose);
        place(skeleton, pose, placed);
        const auto stance = stance_of(map, placed);
        if (!stance) return std::nullopt;
        poses.stances.push_back(*stance);
        const glm::dvec3 foot = minus(placed[static_cast<std::size_t>(map[Bone::LeftFoot].node)].position,
                                      placed[static_cast<std::size_t>(map[Bone::Hips].node)].position);
        poses.leg = std::max(poses.leg, length(foot));
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], foot[axis]);
            high[axis] = std::max(high[axis], foot[axis]);
        }
    }
    poses.swing = length(minus(high, low));
    return poses;
}

constexpr double aligned = 0.9;  // cosine of 26 degrees

/// True if the figure is upright in the clip, on average within 45 degrees. Then only the rest pose lies, as
/// in files that store motion relative to an arbitrary pose.
bool stands_in(const Poses& poses) {
    glm::dvec3 sum(0.0);
    for (const Stance& each : poses.stances) sum = plus(sum, plus(each.torso, each.legs));
    const auto mean = direction_of(sum, 1e-9);
    return mean && mean->y > 0.7;
}

}  // namespace

std::optional<glm::dquat> upright_turn(const Skeleton& skeleton, const BoneMap& map, const Clip& clip) {
    if (!map.is_usable()) return std::nullopt;
    const auto poses = poses_of(skeleton, map, clip);
    if (!poses) return std::nullopt;
    glm::dvec3 sum(0.0);
    for (const Stance& each : poses->stances) sum = plus(sum, each.torso);
    const auto mean = direction_of(sum, 1e-9);
    if (!mean) return std::nullopt;
    const glm::dvec3 axis = nearest_axis(*mean);
    if (axis.y > 0.5) return std::nullopt;
    // Sleepers take no steps; swimmers and crawlers take small ones or bend their legs.
    if (poses->swing < 0.45 * poses->leg) return std::nullopt;
    for (const Stance& each : poses->stances)
        if (dot(each.torso, axis) < aligned || dot(each.legs, axis) < aligned) return std::nullopt;
    return minimal_rotation(axis, glm::dvec3(0.0, 1.0, 0.0));
}

void check_axis(Check& check) {
    const std::size_t last = check.report.frames - 1;
    const std::int32_t hips = check.map[Bone::Hips].node;
    if (check.map.missing.empty() && !check.map.upright) {
        // The legs of a lying body continue the line of its back; a quadruped's do not.
        std::vector<Placement> placed(check.skeleton.size());
        place(check.skeleton, rest_pose(check.skeleton), placed);
        const auto rest = stance_of(check.map, placed);
        if (!rest || dot(rest->torso, rest->legs) < aligned) return;
        if (const auto poses = poses_of(check.skeleton, check.map, check.clip); poses && stands_in(*poses))
            return;
        const double angle = arctangent(length(cross(rest->torso, {0.0, 1.0, 0.0})), rest->torso.y) * degrees;
        check.add(Fault::Axis, hips, 0, 0, last, angle, "deg",
                  "lies down at rest, " + shown(angle) +
                      " degrees from upright: the file's up axis is probably wrong");
    } else if (const auto turn = upright_turn(check.skeleton, check.map, check.clip)) {
        const double angle = 2.0 * half_angle_between(*turn, {1.0, 0.0, 0.0, 0.0}) * degrees;
        check
            .add(Fault::Axis, hips, 0, 0, last, angle, "deg",
                 "lies on its side in this clip, " + shown(angle) + " degrees from upright")
            .has_cure = true;
    }
}

}  // namespace tendril::humanoid::lint_detail
