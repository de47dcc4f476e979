// Joint limits: an adult's ranges, or those seen in clips, as the user chooses for all joints or for each.
#pragma once

#include <memory>
#include <optional>
#include <tendril/humanoid/bone_map.hpp>
#include <tendril/humanoid/limits.hpp>
#include <vector>

#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"
#include "app/labs/kit/limit_shape.hpp"

namespace tendril::app {

/// The ranges of one character and bone map. Both ranges have the same kinds and axes.
class LimitRanges {
  public:
    LimitRanges(SharedCharacter loaded, std::shared_ptr<const humanoid::BoneMap> map);

    bool is_of(const HumanoidPart& part) const { return loaded_ == part.loaded && map_ == part.map; }
    /// Null for the hips and for unmapped bones.
    const ik::Limit* adult(humanoid::Bone bone) const;
    /// Also null if no clip turns the joint.
    const ik::Limit* clips(humanoid::Bone bone) const;
    /// The limits that apply.
    humanoid::BodyLimits in_force(const IkSettings& ik) const;

    /// Null if the map does not describe a body.
    const humanoid::BodyJoints* joints() const { return joints_ ? &*joints_ : nullptr; }

    /// The joint's current angles, and the shape of its limit. Only for joints with an adult() limit.
    ik::JointAngles angles(humanoid::Bone bone, const ShownPose& shown) const;
    LimitShape shape(humanoid::Bone bone, const ik::Limit& limit, const ShownPose& shown) const;

  private:
    const humanoid::BodyLimits& learned() const;

    SharedCharacter loaded_;
    std::shared_ptr<const humanoid::BoneMap> map_;
    humanoid::BodyLimits adult_;
    mutable std::optional<humanoid::BodyLimits> learned_;  // computed on first use: clips may be long
    std::optional<humanoid::BodyJoints> joints_;
};

/// A joint's current state, for drawing, inspector and --state.
struct JointNow {
    const ik::Limit* adult = nullptr;     ///< never null
    const ik::Limit* clips = nullptr;     ///< null if no clip turns the joint
    const ik::Limit* in_force = nullptr;  ///< `adult` or `clips`; null if not limited
    LimitsFrom from = LimitsFrom::Defaults;
    ik::JointAngles angles{};
    float excess = 0.0f;  ///< radians beyond the limit in force
    bool held = false;    ///< at its limit: IK would turn it further
};
/// Empty if the joint has no limits, or the body is not solved.
std::optional<JointNow> joint_now(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown,
                                  humanoid::Bone bone);

/// How far angles exceed a joint's limit, radians. For a hinge, only the bend counts.
float excess_of(const ik::Limit& limit, ik::JointAngles angles);

// The selected joints with limits, for drawing, inspector and --state.

struct SelectedJoints {
    std::vector<humanoid::Bone> all;      ///< in bone order
    std::optional<humanoid::Bone> shown;  ///< the active joint or, if without limits, the last selected one

    bool has(humanoid::Bone bone) const;
};

/// Empty if the body is not solved.
SelectedJoints selected_joints(const HumanoidPart& part, Solvers& solvers);

}  // namespace tendril::app
