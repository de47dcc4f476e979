// What can make a chain of bones flip that reaches for a target: as much as the places of its joints show.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace tendril::app {

/// Radians, 0 to pi; 0 where one of them has no length.
float angle_between(glm::vec3 a, glm::vec3 b);
/// Between two rotations, 0 to pi.
double turn_between(const glm::dquat& a, const glm::dquat& b);
/// Metres from `point` to the line from `a` to `b`, no further than its ends.
float distance_to(glm::vec3 point, glm::vec3 a, glm::vec3 b);

/// A chain just before a flip, or just after it; one joint at least.
struct ReachPose {
    std::vector<glm::vec3> joints{};  ///< from the root on
    glm::vec3 target{0.0f};
    std::optional<glm::vec3> pole{};  ///< the pole target

    glm::vec3 root() const { return joints.front(); }
};

/// `reach`: metres, here and below. Closer than a fiftieth of it.
bool went_through_root(const ReachPose& before, const ReachPose& after, float reach);

/// Where the line from root to target passes the pole target, on either side of the root, the plane that the
/// chain bends in has no direction.
struct PolePassage {
    bool passed = false;  ///< between the two
    bool close = false;   ///< it is near the pole at one of them
};
PolePassage pole_passage(const ReachPose& before, const ReachPose& after);

/// One of the two was.
bool was_straight(const ReachPose& before, const ReachPose& after, float reach);

}  // namespace tendril::app
