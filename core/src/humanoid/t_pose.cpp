#include "tendril/humanoid/t_pose.hpp"

#include "humanoid/anatomy.hpp"
#include "humanoid/input.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {

using namespace rig::detail;

std::vector<rig::Transform> t_pose(const Skeleton& skeleton, const BoneMap& given) {
    const BoneMap& map = detail::map_or_none(given, skeleton);
    std::vector<rig::Transform> pose = rest_pose(skeleton);
    std::vector<Placement> placements(skeleton.size());
    place(skeleton, pose, placements);
    const Facing at = facing(skeleton, map);
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
                turns[node] = {1.0, 0.0, 0.0, 0.0};
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
