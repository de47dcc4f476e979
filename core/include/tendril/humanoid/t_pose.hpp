// The pose from which the joints of a body are measured: arms straight to the sides, legs straight down, all
// else as it rests. Files rest in many poses, an A-pose above all; limits and retargeting want one.
#pragma once

#include "tendril/humanoid/bone_map.hpp"

namespace tendril::humanoid {

/// The character's own directions at rest: unit vectors at right angles to each other, `up` along Y.
/// `forward` follows from `left`; where the feet point backwards by that, because the map has the sides
/// exchanged or the figure is a mirror image, it goes by the feet.
struct Facing {
    glm::dvec3 left{1.0, 0.0, 0.0};  ///< from the right hip and shoulder to the left ones
    glm::dvec3 up{0.0, 1.0, 0.0};
    glm::dvec3 forward{0.0, 0.0, 1.0};
};
/// As the limbs that are mapped tell; the defaults where none is.
Facing facing(const Skeleton& skeleton, const BoneMap& map);

/// Local to the parents, as rest_pose(): upper and lower arms point to their sides, upper and lower legs
/// down, by the smallest rotations that do it; feet keep the rotation they rest with. A limb that is not
/// mapped keeps its rest.
std::vector<rig::Transform> t_pose(const Skeleton& skeleton, const BoneMap& map);

}  // namespace tendril::humanoid
