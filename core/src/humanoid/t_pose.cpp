#include "tendril/humanoid/t_pose.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "humanoid/anatomy.hpp"
#include "humanoid/facing.hpp"
#include "humanoid/input.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {

using namespace rig::detail;

namespace {

/// The vector from the ankle to the ball or tip of the foot at rest; nullopt if nothing follows the ankle.
std::optional<glm::dvec3> foot_at_rest(const Skeleton& skeleton, const BoneMap& map,
                                       std::span<const Placement> rest, bool left) {
    const std::int32_t foot = map[left ? Bone::LeftFoot : Bone::RightFoot].node,
                       toes = map[left ? Bone::LeftToes : Bone::RightToes].node;
    if (foot < 0) return std::nullopt;
    const auto node = static_cast<std::size_t>(foot);
    const std::size_t end =
        toes >= 0 ? static_cast<std::size_t>(toes) : detail::farthest_below(skeleton, rest, node);
    return direction_of(minus(rest[end].position, rest[node].position), 1e-9);
}

/// The standing pose of a foot, derived from its rest pose.
class Standing {
  public:
    Standing(const Skeleton& skeleton, const BoneMap& map, const std::vector<Placement>& rest,
             const Facing& at)
        : at_(at), feet_{foot_at_rest(skeleton, map, rest, true), foot_at_rest(skeleton, map, rest, false)} {}

    /// The rotation from rest to standing. `with_leg`: the leg's turn. A foot that could stand as it is at
    /// rest keeps its rest; any other (a bind pose in mid-run) turns with its leg and points like the other
    /// foot, or 30 degrees below level.
    glm::dquat turn(bool left, const glm::dquat& with_leg) const {
        const auto &own = feet_[left ? 0 : 1], &other = feet_[left ? 1 : 0];
        if (!own || stands(*own)) return {1.0, 0.0, 0.0, 0.0};
        glm::dvec3 goal = minus(times(at_.forward, 0.866025403784439), times(at_.up, 0.5));
        if (other && stands(*other)) {
            const double out = dot(*other, at_.left);
            goal = minus(*other, times(at_.left, 2.0 * out));
        }
        return math::compose(minimal_rotation(rotated(with_leg, *own), goal), with_leg);
    }

  private:
    /// True if it points forward: at most 60 degrees out or in, from 20 degrees above level to 70 below.
    bool stands(const glm::dvec3& foot) const {
        const double ahead = dot(foot, at_.forward), aside = dot(foot, at_.left), high = dot(foot, at_.up);
        return high < 0.342 && high > -0.94 && ahead > 0.5 * std::sqrt(ahead * ahead + aside * aside);
    }

    const Facing& at_;
    std::array<std::optional<glm::dvec3>, 2> feet_;  // left, right
};

}  // namespace

std::vector<rig::Transform> t_pose(const Skeleton& skeleton, const BoneMap& given) {
    const BoneMap& map = detail::map_or_none(given, skeleton);
    std::vector<rig::Transform> pose = rest_pose(skeleton);
    std::vector<Placement> placements(skeleton.size());
    place(skeleton, pose, placements);
    const Facing at = facing(skeleton, map);
    const Standing standing(skeleton, map, placements, at);
    std::vector<glm::dquat> turns(skeleton.size(),
                                  glm::dquat(1.0, 0.0, 0.0, 0.0));  // from rest to the T-pose
    for (const std::int32_t each : skeleton.order()) {
        const auto node = static_cast<std::size_t>(each);
        const std::int32_t parent = skeleton[node].parent;
        const glm::dquat before =
            parent < 0 ? glm::dquat(1.0, 0.0, 0.0, 0.0) : turns[static_cast<std::size_t>(parent)];
        turns[node] = before;
        if (const auto bone = detail::bone_of(map, each)) {
            const auto child = detail::limb_child(*bone);
            if (child && map[*child].node >= 0) {
                const glm::dvec3 along =
                    minus(placements[static_cast<std::size_t>(map[*child].node)].position,
                          placements[node].position);
                if (const auto direction = direction_of(rotated(before, along), 1e-9))
                    turns[node] =
                        math::compose(minimal_rotation(*direction, detail::t_direction(*bone, at)), before);
            } else if (*bone == Bone::LeftFoot || *bone == Bone::RightFoot) {
                turns[node] = standing.turn(*bone == Bone::LeftFoot, before);
            }
        }
        const glm::dquat rest = placements[node].rotation();
        const glm::dquat above =
            parent < 0 ? before
                       : math::compose(before, placements[static_cast<std::size_t>(parent)].rotation());
        if (turns[node] != before)
            pose[node].rotation =
                rig::normalised(math::compose(conjugate(above), math::compose(turns[node], rest)));
    }
    return pose;
}

}  // namespace tendril::humanoid
