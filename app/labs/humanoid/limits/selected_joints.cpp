#include "app/labs/humanoid/limits/selected_joints.hpp"

#include <algorithm>

#include "app/labs/humanoid/limits/limit_ranges.hpp"

namespace tendril::app {

using humanoid::Bone;

bool SelectedJoints::has(Bone bone) const {
    return std::find(all.begin(), all.end(), bone) != all.end();
}

SelectedJoints selected_joints(const HumanoidPart& part, Solvers& solvers) {
    SelectedJoints joints;
    if (part.selection.empty() || solvers.body(part) == nullptr) return joints;
    const LimitRanges& ranges = solvers.limits(part);
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        const auto node = part.node_of(bone);
        if (!node || !part.selection.has(*node) || ranges.adult(bone) == nullptr) continue;
        joints.all.push_back(bone);
        if (part.selection.active() == *node) joints.shown = bone;
    }
    if (!joints.shown && !joints.all.empty()) joints.shown = joints.all.back();
    return joints;
}

}  // namespace tendril::app
