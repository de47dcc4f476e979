// How far the joints of a character may turn: as an adult's do, and as its clips turn them. Which of the two
// holds, a person says, for all joints or for one.
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

/// Of one character with its map: what a person chooses among. Both have the same kinds and axes.
class LimitRanges {
  public:
    LimitRanges(SharedCharacter loaded, std::shared_ptr<const humanoid::BoneMap> map);

    bool is_of(const HumanoidPart& part) const { return loaded_ == part.loaded && map_ == part.map; }
    /// Null where the joint is not limited: the hips, and what is not mapped.
    const ik::Limit* adult(humanoid::Bone bone) const;
    /// Null, too, where no clip turns it.
    const ik::Limit* clips(humanoid::Bone bone) const;
    /// Those that hold.
    humanoid::BodyLimits in_force(const IkSettings& ik) const;

    /// Null where the map is not one of a body.
    const humanoid::BodyJoints* joints() const { return joints_ ? &*joints_ : nullptr; }

    /// Turned as it is shown, and where its limit lies then. For a joint that adult() has a limit of.
    ik::JointAngles angles(humanoid::Bone bone, const ShownPose& shown) const;
    LimitShape shape(humanoid::Bone bone, const ik::Limit& limit, const ShownPose& shown) const;

  private:
    const humanoid::BodyLimits& learned() const;

    SharedCharacter loaded_;
    std::shared_ptr<const humanoid::BoneMap> map_;
    humanoid::BodyLimits adult_;
    mutable std::optional<humanoid::BodyLimits> learned_;  // when it is first asked for: clips may be long
    std::optional<humanoid::BodyJoints> joints_;
};

/// A joint as it is now, for picture, inspector and state.
struct JointNow {
    const ik::Limit* adult = nullptr;     ///< never null
    const ik::Limit* clips = nullptr;     ///< null where no clip turns it
    const ik::Limit* in_force = nullptr;  ///< one of the two; null where nothing limits it
    LimitsFrom from = LimitsFrom::Defaults;
    ik::JointAngles angles{};
    float excess = 0.0f;  ///< radians beyond what is in force
    bool held = false;    ///< IK would turn it further
};
/// Nothing where the joint has no limits, or the body is not solved.
std::optional<JointNow> joint_now(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown,
                                  humanoid::Bone bone);

/// By how much angles exceed a limit of a body's joint; of a hinge only its own turn counts. Radians.
float excess_of(const ik::Limit& limit, ik::JointAngles angles);

// The joints with limits among what is selected, for picture, inspector and state.

struct SelectedJoints {
    std::vector<humanoid::Bone> all;      ///< by bone
    std::optional<humanoid::Bone> shown;  ///< the active one, or where it has no limits the last of all

    bool has(humanoid::Bone bone) const;
};

/// None where the body is not solved.
SelectedJoints selected_joints(const HumanoidPart& part, Solvers& solvers);

}  // namespace tendril::app
