// Connections between the bones of a body, and their directions in a T-pose. Not installed.
#pragma once

#include <optional>
#include <span>

#include "tendril/humanoid/t_pose.hpp"

namespace tendril::humanoid::detail {

inline std::optional<Bone> bone_of(const BoneMap& map, std::int32_t node) noexcept {
    for (std::size_t i = 0; i < bone_count; ++i)
        if (map.bones[i].node == node) return static_cast<Bone>(i);
    return std::nullopt;
}

inline bool is_left(Bone bone) noexcept {
    return name(bone)[0] == 'L';
}

/// The bone that follows an upper or lower arm or leg in its limb; none for all others.
inline std::optional<Bone> limb_child(Bone bone) noexcept {
    for (const Bone upper :
         {Bone::LeftUpperArm, Bone::RightUpperArm, Bone::LeftUpperLeg, Bone::RightUpperLeg}) {
        const int along = static_cast<int>(bone) - static_cast<int>(upper);
        if (along == 0 || along == 1) return static_cast<Bone>(static_cast<int>(bone) + 1);
    }
    return std::nullopt;
}

/// Size of a figure at rest, relative to a height of 1.8 m: hips to head plus a leg, which measure 1.45 m
/// there. The leg is the mean of both, or the one that is mapped. 1 if none of these has a length.
double size_of(const BoneMap& map, std::span<const Placement> rest) noexcept;

/// Direction of a bone in a T-pose.
inline glm::dvec3 t_direction(Bone bone, const Facing& facing) noexcept {
    if (bone < Bone::LeftShoulder || bone > Bone::RightToes) return facing.up;
    if (bone <= Bone::LeftHand) return facing.left;
    if (bone <= Bone::RightHand) return -facing.left;
    for (const Bone below : {Bone::LeftFoot, Bone::LeftToes, Bone::RightFoot, Bone::RightToes})
        if (bone == below) return facing.forward;
    return -facing.up;
}

/// True if a body keeps the first bone out of the second: hands and lower arms out of everything but their
/// own arm and the shoulders, lower legs out of each other.
inline bool may_collide(Bone moving, Bone other) noexcept {
    switch (moving) {
        case Bone::LeftHand:
        case Bone::LeftLowerArm:
            return other != Bone::LeftShoulder && other != Bone::LeftUpperArm &&
                   other != Bone::LeftLowerArm && other != Bone::LeftHand && other != Bone::RightShoulder;
        case Bone::RightHand:
        case Bone::RightLowerArm:
            return other != Bone::RightShoulder && other != Bone::RightUpperArm &&
                   other != Bone::RightLowerArm && other != Bone::RightHand && other != Bone::LeftShoulder;
        case Bone::LeftLowerLeg:
            return other == Bone::RightLowerLeg;
        default:
            return false;
    }
}

}  // namespace tendril::humanoid::detail
