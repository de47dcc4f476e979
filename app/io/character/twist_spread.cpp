#include "app/io/character/skin.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <optional>

namespace tendril::app {
namespace {

using humanoid::Placement;

constexpr double places = 100.0;  // slices along a bone
/// Every GL supports a buffer texture of 65536 texels; a matrix takes three.
constexpr std::size_t max_joints = 65536 / 3;
constexpr double min_twist = 1e-7;  // radians

std::optional<Placement> inverse(const Placement& of) {
    const double volume = glm::determinant(of.axes);
    if (!(std::abs(volume) > 1e-30)) return std::nullopt;
    Placement back{glm::inverse(of.axes), glm::dvec3(0.0)};
    back.position = -(back.axes * of.position);
    return back;
}

/// The rotation of `of` relative to `from`; the identity if `from` is singular.
glm::dquat rotation_from(const Placement& from, const Placement& of) {
    const auto back = inverse(from);
    return back ? (*back * of).rotation() : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

/// The node's joint with the index nearest to `near`, so that both belong to the same skin of the file.
std::optional<std::size_t> joint_near(const Skin& skin, std::size_t node, std::size_t near) {
    std::optional<std::size_t> found;
    const auto away = [near](std::size_t i) { return i > near ? i - near : near - i; };
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
        if (skin.joints[i].node == node && (!found || away(i) < away(*found))) found = i;
    return found;
}

/// The rotation of one node relative to another in the bind pose.
glm::dquat bound_turn(const Skin& skin, std::size_t from, std::size_t of, std::span<const Placement> rest) {
    if (const auto one = joint_near(skin, from, 0)) {
        if (const auto other = joint_near(skin, of, *one)) {
            const auto from_at = inverse(skin.joints[*one].from_bind),
                       of_at = inverse(skin.joints[*other].from_bind);
            if (from_at && of_at) return rotation_from(*from_at, *of_at);
        }
    }
    return rotation_from(rest[from], rest[of]);
}

AffineRows rows_of(const Placement& m) {
    AffineRows rows;
    for (int r = 0; r < 3; ++r)
        rows[static_cast<std::size_t>(r)] =
            glm::vec4(m.axes[0][r], m.axes[1][r], m.axes[2][r], m.position[r]);
    return rows;
}

/// Whether any vertex follows one of these nodes.
bool is_worn(const Skin& skin, const std::vector<std::size_t>& nodes) {
    return std::ranges::any_of(skin.mesh->weights, [&](const JointWeights& by) {
        for (std::size_t i = 0; i < 4; ++i)
            if (by.weights[i] > 0.0f &&
                std::ranges::find(nodes, skin.joints[by.joints[i]].node) != nodes.end())
                return true;
        return false;
    });
}

}  // namespace

TwistSpread::TwistSpread(const Skin& skin, const humanoid::Skeleton& skeleton, const humanoid::BoneMap& map) {
    if (!skin.mesh) return;
    std::vector<Placement> rest(skeleton.size());
    humanoid::place(skeleton, humanoid::rest_pose(skeleton), rest);
    const humanoid::TwistNodes helpers = humanoid::TwistNodes::find(skeleton, map);
    for (const humanoid::TwistBone& bone : humanoid::twist_bones(skeleton, map)) {
        if (const auto nodes = helpers.along(bone.bone); !nodes.empty() && is_worn(skin, nodes)) continue;
        arms_.push_back({bone, bound_turn(skin, bone.above, bone.node, rest),
                         bound_turn(skin, bone.node, bone.end, rest)});
    }
    spread(skin, skeleton, rest);
}

void TwistSpread::spread(const Skin& skin, const humanoid::Skeleton& skeleton,
                         std::span<const Placement> rest) {
    /// For a joint on an arm's bone: the arm, and the transform from the bind pose to the bone's space.
    struct Bound {
        std::size_t arm;
        Placement to_bone;
    };
    std::vector<std::optional<Bound>> bound(skin.joints.size());
    for (std::size_t j = 0; j < bound.size(); ++j) {
        const std::size_t node = skin.joints[j].node;
        for (std::size_t a = 0; a < arms_.size(); ++a) {
            const humanoid::TwistBone& bone = arms_[a].bone;
            if (!skeleton.is_below(node, bone.node) || skeleton.is_below(node, bone.end)) continue;
            if (const auto back = inverse(rest[bone.node]))
                bound[j] = {a, *back * rest[node] * skin.joints[j].from_bind};
        }
    }
    auto weights = std::make_shared<std::vector<JointWeights>>(skin.mesh->weights);
    std::map<std::pair<std::size_t, long>, std::size_t> made;
    for (std::size_t i = 0; i < weights->size(); ++i) {
        JointWeights& by = (*weights)[i];
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t joint = by.joints[k];
            if (!(by.weights[k] > 0.0f) || !bound[joint]) continue;
            const glm::dvec3 at = bound[joint]->to_bone.apply(glm::dvec3(skin.mesh->positions[i]));
            const long place = std::lround(places * arms_[bound[joint]->arm].bone.part(at));
            const auto [found, is_new] =
                made.try_emplace({joint, place}, skin.joints.size() + copies_.size());
            if (is_new) copies_.push_back({bound[joint]->arm, joint, static_cast<double>(place) / places});
            by.joints[k] = static_cast<std::uint16_t>(found->second);
        }
    }
    if (skin.joints.size() + copies_.size() > max_joints) copies_.clear();
    if (!copies_.empty()) weights_ = std::move(weights);
}

std::vector<AffineRows> TwistSpread::matrices(const Skin& skin, std::span<const Placement> placements) const {
    std::vector<AffineRows> rows = skin_matrices(skin, placements);
    if (copies_.empty()) return rows;
    std::vector<humanoid::BoneTwist> twists;
    for (const Arm& arm : arms_) {
        const Placement &above = placements[arm.bone.above], &bone = placements[arm.bone.node],
                        &end = placements[arm.bone.end];
        twists.push_back(bone_twist(arm.bone, glm::conjugate(arm.bound) * rotation_from(above, bone),
                                    rotation_from(bone, end) * glm::conjugate(arm.end_bound)));
    }
    rows.reserve(rows.size() + copies_.size());
    for (const Copy& copy : copies_) {
        const humanoid::TwistBone& bone = arms_[copy.arm].bone;
        const double by = twists[copy.arm].at(copy.part);
        const SkinJoint& joint = skin.joints[copy.joint];
        const auto back = inverse(placements[bone.node]);
        if (!(std::abs(by) > min_twist) || !back) {
            rows.push_back(rows[copy.joint]);
            continue;
        }
        const Placement turned{glm::mat3_cast(glm::angleAxis(by, glm::normalize(bone.way))), glm::dvec3(0.0)};
        rows.push_back(
            rows_of(placements[bone.node] * turned * (*back * (placements[joint.node] * joint.from_bind))));
    }
    return rows;
}

}  // namespace tendril::app
