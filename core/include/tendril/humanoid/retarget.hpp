// Retargets a clip from one skeleton to another.
//
//     const Expected<Retargeted> walk = retarget({mocap, mocap_map}, clip, {robot, robot_map});
//     if (!walk) return log(walk.message());  // "retarget: from.map must have Hips, got none"
//     sample(walk->clip, robot, seconds, pose);
//
// Directions. Each bone that both maps have turns from its reference pose as the source's bone does, in the
// frame of its own character (facing()). The reference pose is the T-pose (t_pose.hpp) with hands, fingers
// and feet straightened: the hand points along the arm, from the wrist to the middle finger, and the foot
// points forward, from the ankle to the ball. So arms, hands and feet point in the same directions, whatever
// the rest poses and the axes of the nodes are. Rotations are taken in the character's space. If only the
// source has a bone, such as a third one in the spine, the bones after it include its turn; a bone that only
// the target has stays at rest. Fingers are matched by name. (VRM Consortium, "VRMC_vrm_animation-1.0", 2024,
// does the same between T-poses.)
//
// Root. The topmost node above the hips travels with them over the ground; it neither rises nor turns. Its
// other children travel with it. A helper beside the body that is at one of its nodes at rest (within a tenth
// of a leg), like an IK target, follows that node; so do palm bones beside the hand.
//
// Feet. The hips move as the source's do, scaled by the ratio of the legs' lengths. The source's stances are
// found as the lint finds them (lint.hpp), and are kept: the sole stands on the target's ground, and slides
// only if the source's foot slides by over 4 cm. Legs are solved in closed form. Between stances the
// displacement of the ankle blends from one to the next; the hips are lowered, smoothly, where a leg would be
// too short. If a clip ends as it begins, its last frame leads into its first. (Stances as constraints, and
// smooth displacements that meet them: M. Gleicher, "Retargetting Motion to New Characters", SIGGRAPH 1998.
// Closed-form legs instead of his optimisation, in the spirit of K. Choi, H. Ko, "On-line Motion
// Retargetting", Pacific Graphics 1999.) Both figures need whole legs for that; otherwise, or if no foot of
// the source ever stands, the hips keep their height over the ground.
//
// A figure with the same nodes and rest pose, even in another size, gets the clip itself.
//
// Feet turn relative to how they stand at rest, whatever the clip does later. If the source's rest pose does
// not stand on level ground, such as a zero pose or a bind pose in mid-run, the standing pose is learned from
// frames in which a foot carries a figure that neither sits nor lies; if there are none, t_pose() provides
// it.
//
// The target stands on its floor at rest, or on height 0 if its rest pose is far from its floor, as in many
// BVH files.
//
// Cost: two passes over the keys, linear in their number. About 3700 instructions for each key and each node
// of both skeletons, 1 to 2 µs: 2 s for 10 000 keys of 38 nodes on 67.
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
    Clip clip{};                   ///< for the target, with the source's name, duration and rate
    double scale = 1.0;            ///< scale of the hips' translation: the ratio of the legs' lengths
    std::vector<Bone> left_out{};  ///< bones of the source that the target lacks
    std::vector<Bone> at_rest{};   ///< bones of the target that the source lacks
    /// Nodes of the target that are neither above nor below its hips and follow no node.
    std::vector<std::size_t> helpers{};
};

/// Keys are linear, at every key of the source and at every frame of frame_rate(). Refuses a map or clip that
/// fails check(), maps without Hips, and clips with more than 100000 such keys.
Expected<Retargeted> retarget(const MappedSkeleton& from, const Clip& clip, const MappedSkeleton& to);

}  // namespace tendril::humanoid
