// The joints with limits among what is selected, for picture, inspector and state.
#pragma once

#include <optional>
#include <tendril/humanoid/bone_map.hpp>
#include <vector>

#include "app/labs/humanoid/ik/solvers.hpp"

namespace tendril::app {

struct SelectedJoints {
    std::vector<humanoid::Bone> all;      ///< by bone
    std::optional<humanoid::Bone> shown;  ///< the active one, or where it has no limits the last of all

    bool has(humanoid::Bone bone) const;
};

/// None where the body is not solved.
SelectedJoints selected_joints(const HumanoidPart& part, Solvers& solvers);

}  // namespace tendril::app
