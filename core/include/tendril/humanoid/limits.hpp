// Joint limits of a body: a human's by default, or learned from clips.
//
//     BodyLimits limits = default_limits(skeleton, map);
//     Expected<BodyJoints> joints = BodyJoints::make(skeleton, map, limits);
//     joints->measure(Bone::LeftLowerArm, placements);  // in the axes of its limit
//     joints->excess(Bone::LeftLowerArm, placements);   // radians beyond the limit; 0: within it
//
// A joint's angles are its bone's, relative to its parent bone, measured from the T-pose (t_pose.hpp); axes
// are in the character's space. Limits work as for a chain (tendril/ik/limit.hpp), except that a hinge does
// not restrict turns about other axes: clips have them, and they are left alone.
//
// Source of the default angles: W. Greene, J. Heckman (eds.), "The Clinical Measurement of Joint Motion",
// American Academy of Orthopaedic Surgeons, 1994, rounded; the spine's are divided among its bones.
#pragma once

#include "tendril/humanoid/clip.hpp"
#include "tendril/humanoid/t_pose.hpp"
#include "tendril/ik/limit.hpp"

namespace tendril::humanoid {

/// Indexed by bone. The default limit of the hips is free: they place the whole body.
using BodyLimits = std::array<ik::Limit, bone_count>;

/// All joints free.
BodyLimits no_limits() noexcept;
/// The limits of an adult. Elbows and knees are hinges; one bent by more than 5 degrees at rest turns about
/// the axis of that bend, unless it is overstretched by under 15 degrees. A shoulder shorter than a tenth of
/// its arm is no collar bone and turns as far as the arm.
BodyLimits default_limits(const Skeleton& skeleton, const BoneMap& map);
/// The range over which the clips turn each joint, sampled 60 times a second, plus a degree. Kinds and axes
/// are taken from `like`; a bone that no clip turns, or that is not mapped, keeps its limit from `like`.
/// Clips must have passed check().
BodyLimits learned_limits(const Skeleton& skeleton, const BoneMap& map, std::span<const Clip> clips,
                          const BodyLimits& like);

/// Measures the joints of a body. A value.
class BodyJoints {
  public:
    /// Refuses an invalid limit, with the bone's name: "LeftLowerArm: the hinge's min is over its max".
    static Expected<BodyJoints> make(const Skeleton& skeleton, const BoneMap& map, const BodyLimits& limits);

    /// The joint's rotation from the T-pose, in the parent bone's frame; the identity if the bone is not
    /// mapped. `placements` has one for every node.
    glm::dquat turn(Bone bone, std::span<const Placement> placements) const noexcept;
    ik::JointAngles measure(Bone bone, std::span<const Placement> placements) const noexcept;
    /// Radians beyond the limit; 0 within it, and for a bone that is free or not mapped.
    float excess(Bone bone, std::span<const Placement> placements) const noexcept;

    /// The nearest mapped bone above; none for the hips and for a bone that is not mapped.
    std::optional<Bone> parent(Bone bone) const noexcept;
    /// Direction of the bone in the T-pose, in the character's space; unit length.
    const glm::dvec3& direction(Bone bone) const noexcept { return joint(bone).direction; }
    const ik::Limit& limit(Bone bone) const noexcept { return joint(bone).limit; }
    /// The rotation of the bone's node in the T-pose, in the character's space.
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
