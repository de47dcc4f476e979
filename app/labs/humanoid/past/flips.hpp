// Which bones of a body jumped from one pose to the next, while what drives them hardly moved.
#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <tendril/humanoid/body.hpp>
#include <vector>

#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/kit/part_cache.hpp"

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

// The character as it was shown at a moment of the last ten seconds. A part has no pose, it follows from it
// by the whole of a solve: it is worked out once for each moment.

struct PastPose {
    struct Node {
        glm::vec3 position{0.0f};
        glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    };
    std::vector<Node> nodes;
    /// To the effectors' targets, metres; NaN of one that has none.
    std::array<float, humanoid::effector_count> left{};
};
inline std::size_t bytes_beyond(const PastPose& pose) {
    return pose.nodes.size() * sizeof(PastPose::Node);
}
using PastPoses = PartCache<PastPose>;

}  // namespace tendril::app
