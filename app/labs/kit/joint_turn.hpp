// A turn of a joint in the terms that people know: swing, where its bone points, and twist, about the bone.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace tendril::app {

/// Degrees.
struct JointTurn {
    double swing = 0.0;  ///< 0 to 180
    double twist = 0.0;  ///< -180 to 180
    double angle = 0.0;  ///< of both together: 0 to 180
};

/// `turn`: from rest, a rotation of any length but 0. `along`: where the bone points at rest, in the same
/// frame, of any length but 0. The twist of a bone that points the very other way than at rest is 0.
JointTurn joint_turn(const glm::dquat& turn, const glm::dvec3& along);

}  // namespace tendril::app
