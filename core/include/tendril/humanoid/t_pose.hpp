// The pose from which the joints of a body are measured: arms straight to the sides, legs straight down,
// everything else at rest. Files have various rest poses, often an A-pose; limits and retargeting need one.
#pragma once

#include "tendril/humanoid/bone_map.hpp"

namespace tendril::humanoid {

/// The character's own directions at rest: orthogonal unit vectors, `up` along Y. `forward` follows from
/// `left`; if the feet then point backwards, because the map has the sides swapped or the figure is a mirror
/// image, it is reversed.
struct Facing {
    glm::dvec3 left{1.0, 0.0, 0.0};  ///< from the right hip and shoulder to the left ones
    glm::dvec3 up{0.0, 1.0, 0.0};
    glm::dvec3 forward{0.0, 0.0, 1.0};
};
/// Derived from the mapped limbs; the defaults if neither arms nor legs are mapped on both sides.
Facing facing(const Skeleton& skeleton, const BoneMap& map);

/// Transforms local to the parents, like rest_pose(). Minimal rotations point the upper and lower arms to
/// their sides, and the upper and lower legs down. A foot that could stand as it is at rest keeps its rest
/// rotation; any other, as in a bind pose in mid-run, turns with its leg and then points like the other foot.
/// A limb that is not mapped keeps its rest pose.
std::vector<rig::Transform> t_pose(const Skeleton& skeleton, const BoneMap& map);

}  // namespace tendril::humanoid
