// A clip of one skeleton, played on another.
//
//     const Expected<Retargeted> walk = retarget({mocap, mocap_map}, clip, {robot, robot_map});
//     if (!walk) return log(walk.message());  // "retarget: from.map must have Hips, got none"
//     sample(walk->clip, robot, seconds, pose);
//
// Method: each bone that both maps have turns as the source's turns from its T-pose (t_pose.hpp), in the
// frame of the character that it belongs to (facing()). So arms and legs point in the same directions,
// whatever the rest poses and the axes of the nodes are. Rotations are taken in the character's space: what
// the source has more of, such as a third bone of the spine, is included in the bones above it; what it lacks
// stays at rest. The hips move from their rest as the source's do, scaled by the ratio of the heights of hips
// over feet. (VRM Consortium, "VRMC_vrm_animation-1.0", 2024, does the same between T-poses.)
//
// Cost: O(nodes) per key.
#pragma once

#include <vector>

#include "tendril/humanoid/bone_map.hpp"
#include "tendril/humanoid/clip.hpp"

namespace tendril::humanoid {

struct MappedSkeleton {
    const Skeleton& skeleton;
    const BoneMap& map;
};

struct Retargeted {
    Clip clip{};                   ///< of the target; has the source's name, duration and rate
    double scale = 1.0;            ///< of the hips' translation
    std::vector<Bone> left_out{};  ///< bones of the source that the target lacks
    std::vector<Bone> at_rest{};   ///< bones of the target that the source lacks
};

/// Keys are linear, at every key of the source and at every frame of frame_rate(). Refuses a map or clip that
/// fails check(), maps without Hips, and clips with more than 100000 such keys.
Expected<Retargeted> retarget(const MappedSkeleton& from, const Clip& clip, const MappedSkeleton& to);

}  // namespace tendril::humanoid
