// The character as it was shown at a moment of the last ten seconds. A part has no pose, it follows from it
// by the whole of a solve: it is worked out once for each moment.
#pragma once

#include <array>
#include <optional>
#include <tendril/humanoid/body.hpp>
#include <tendril/humanoid/skeleton.hpp>
#include <vector>

#include "app/labs/kit/part_cache.hpp"

namespace tendril::app {

struct PastPose {
    std::vector<humanoid::Placement> placed;                           ///< of every node
    std::array<std::optional<double>, humanoid::effector_count> left;  ///< to the effectors' targets, metres
};
using PastPoses = PartCache<PastPose>;

}  // namespace tendril::app
