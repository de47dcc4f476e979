// The character as it was shown at a moment of the last ten seconds. A part has no pose, it follows from it
// by the whole of a solve: it is worked out once for each moment.
#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <tendril/humanoid/body.hpp>
#include <vector>

#include "app/labs/kit/part_cache.hpp"

namespace tendril::app {

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
