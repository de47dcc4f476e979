// Which bones of a body jumped from one pose to the next, while what drives them hardly moved.
#pragma once

#include <string>
#include <vector>

#include "app/labs/humanoid/ik/shown_pose.hpp"

namespace tendril::app {

/// A part, and how the character is shown by it.
struct HumanoidMoment {
    const HumanoidPart& part;
    const ShownPose& shown;

    /// What the clip alone makes of it.
    const std::vector<humanoid::Placement>& clip() const {
        return shown.before.empty() ? shown.placed : shown.before;
    }
};

/// A bone that flipped, by FlipRule: the clip did not turn it or what it hangs on as much, and no target, as
/// the bone sees it from where the clip has it, moved far. A weight that the solve blends by counts as moved
/// far where it changed by the rule's share. What hangs on a bone that was driven goes along with it.
struct BodyFlip {
    humanoid::Bone bone = humanoid::Bone::Hips;
    double radians = 0.0;  ///< that it turned, in the scene
};

/// The bone that turned the furthest of each limb that jumped; of those that turned together, the one nearest
/// to the hips. Two moments of one character under the same settings, but for where targets are. None while a
/// target that was let go fades out, and none of what springs swing.
std::vector<BodyFlip> body_flips(const HumanoidMoment& was, const HumanoidMoment& is, Solvers& solvers);

/// Why it did, as far as the solves' reports and the poses show it; else "cause not known".
std::string flip_cause(const HumanoidMoment& was, const HumanoidMoment& is, humanoid::Bone bone);

}  // namespace tendril::app
