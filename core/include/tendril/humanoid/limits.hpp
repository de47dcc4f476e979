// How far the joints of a body turn: of a human by default, or as far as given clips really turn them.
//
//     BodyLimits limits = default_limits(skeleton, map);
//     Expected<BodyJoints> joints = BodyJoints::make(skeleton, map, limits);
//     joints->measure(Bone::LeftLowerArm, placements);  // in the axes of its limit
//     joints->excess(Bone::LeftLowerArm, placements);   // radians beyond it; 0: within
//
// A joint's angles are those of its bone against the bone before it in the body, both taken from the T-pose
// (t_pose.hpp); axes are in the character's space. They are limits as those of a chain
// (tendril/ik/limit.hpp): a hinge says nothing about turns other than its own, which come from clips and are
// left alone.
//
// Source of the default angles: W. Greene, J. Heckman (eds.), "The Clinical Measurement of Joint Motion",
// American Academy of Orthopaedic Surgeons, 1994, rounded; those of the spine are shared by the bones that it
// has.
#pragma once

#include "tendril/humanoid/clip.hpp"
#include "tendril/humanoid/t_pose.hpp"
#include "tendril/ik/limit.hpp"

namespace tendril::humanoid {

/// By bone. The hips' is free: they are where the body is.
using BodyLimits = std::array<ik::Limit, bone_count>;

/// All free.
BodyLimits no_limits() noexcept;
/// Of an adult. Elbows and knees are hinges; where they rest bent by more than 5 degrees, about the axis of
/// that bend.
BodyLimits default_limits(const Skeleton& skeleton, const BoneMap& map);
/// As far as the clips turn each joint, sampled 60 times a second, and a degree more; kinds and axes are
/// those of `like`. A bone that no clip turns, or that is not mapped, keeps the limit it has there. Clips
/// pass check().
BodyLimits learned_limits(const Skeleton& skeleton, const BoneMap& map, std::span<const Clip> clips,
                          const BodyLimits& like);

/// The joints of a body, measured. A value.
class BodyJoints {
  public:
    /// Refuses a limit with a fault, and tells whose: "LeftLowerArm: min must be at most max, got 2 and 1".
    static Expected<BodyJoints> make(const Skeleton& skeleton, const BoneMap& map, const BodyLimits& limits);

    /// From the T-pose, in the frame of the bone before. `placements`: of all nodes. The identity of a bone
    /// that is not mapped.
    glm::dquat turn(Bone bone, std::span<const Placement> placements) const noexcept;
    ik::JointAngles measure(Bone bone, std::span<const Placement> placements) const noexcept;
    /// Radians; 0 within, and of a bone that is free or not mapped.
    float excess(Bone bone, std::span<const Placement> placements) const noexcept;

    /// The bone before it that is mapped; of the hips, and of what is not mapped, none.
    std::optional<Bone> parent(Bone bone) const noexcept;
    /// Where the bone points in the T-pose, in the character's space; unit length.
    const glm::dvec3& direction(Bone bone) const noexcept { return joint(bone).direction; }
    const ik::Limit& limit(Bone bone) const noexcept { return joint(bone).limit; }
    /// Of the bone's node in the T-pose, in the character's space.
    const glm::dquat& rest_rotation(Bone bone) const noexcept { return joint(bone).rest; }

  private:
    struct Joint {
        std::int32_t node = -1;
        int parent = -1;                      // a bone
        glm::dquat rest{1.0, 0.0, 0.0, 0.0};  // the node's rotation in the T-pose
        glm::dvec3 direction{0.0, 1.0, 0.0};
        ik::Limit limit{};
    };
    const Joint& joint(Bone bone) const noexcept { return joints_[static_cast<std::size_t>(bone)]; }
    glm::dquat from_t_pose(const Joint& joint, std::span<const Placement> placements) const noexcept;

    std::array<Joint, bone_count> joints_{};
};

}  // namespace tendril::humanoid
