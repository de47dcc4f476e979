// Finds bones of a body that jumped from one pose to the next although their inputs hardly moved, and why.
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

/// A part with its displayed pose.
struct HumanoidMoment {
    const HumanoidPart& part;
    const ShownPose& shown;

    /// The clip's own pose.
    const std::vector<humanoid::Placement>& clip() const {
        return shown.before.empty() ? shown.placed : shown.before;
    }
};

/// A bone that flipped, by FlipRule: the clip did not turn it or an ancestor that far, and no target moved
/// far relative to the bone's place in the clip. Changing a blend weight by the rule's share counts as moving
/// far. Descendants of a driven bone move with it and do not flip.
struct BodyFlip {
    humanoid::Bone bone = humanoid::Bone::Hips;
    std::size_t node = 0;
    double radians = 0.0;  ///< global rotation
    std::string cause{};   ///< from the solve reports and poses, or "cause not known"
};

/// The bone that turned furthest in each limb that jumped; among equal turns, the one nearest the hips. Both
/// moments must be of one character under the same settings, except for target positions. Empty while a
/// released target fades out. Ignores nodes that springs turn.
std::vector<BodyFlip> body_flips(const HumanoidMoment& was, const HumanoidMoment& is, Solvers& solvers);

// The displayed character at a moment of the last ten seconds. A part stores no pose, and computing one takes
// a whole solve, so it is computed once per moment.

struct PastPose {
    struct Node {
        glm::vec3 position{0.0f};
        glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    };
    std::vector<Node> nodes;
    /// Distances from effectors to their targets, metres; NaN for those without one.
    std::array<float, humanoid::effector_count> left{};
};
inline std::size_t bytes_beyond(const PastPose& pose) {
    return pose.nodes.size() * sizeof(PastPose::Node);
}
using PastPoses = PartCache<PastPose>;

}  // namespace tendril::app
