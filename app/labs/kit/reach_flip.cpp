#include "app/labs/kit/reach_flip.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace tendril::app {
namespace {

constexpr float near_root = 0.02f, straight = 0.02f;  ///< of the reach

/// How far the joints lie from the line from root to tip, in metres.
float bend(const std::vector<glm::vec3>& joints) {
    const glm::vec3 root = joints.front(), line = joints.back() - root;
    const float length = glm::length(line);
    float furthest = 0.0f;
    for (const glm::vec3 joint : joints) {
        const glm::vec3 from_root = joint - root;
        const float off =
            length > 0.0f ? glm::length(glm::cross(from_root, line)) / length : glm::length(from_root);
        furthest = std::max(furthest, off);
    }
    return furthest;
}

}  // namespace

float angle_between(glm::vec3 a, glm::vec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

double turn_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat between = glm::conjugate(a) * b;
    return 2.0 * std::atan2(glm::length(glm::dvec3(between.x, between.y, between.z)), std::abs(between.w));
}

float distance_to(glm::vec3 point, glm::vec3 a, glm::vec3 b) {
    const glm::vec3 along = b - a;
    const float square = glm::dot(along, along);
    const float t = square > 0.0f ? std::clamp(glm::dot(point - a, along) / square, 0.0f, 1.0f) : 0.0f;
    return glm::distance(point, a + t * along);
}

bool went_through_root(const ReachPose& before, const ReachPose& after, float reach) {
    return distance_to(after.root(), before.target, after.target) < near_root * reach;
}

PolePassage pole_passage(const ReachPose& before, const ReachPose& after) {
    if (!before.pole || !after.pole) return {};
    constexpr float close = 0.17f;  // radians, ten degrees
    const glm::vec3 root = after.root();
    const glm::vec3 was = glm::cross(before.target - root, *before.pole - root);
    const glm::vec3 is = glm::cross(after.target - root, *after.pole - root);
    const auto off = [&](const ReachPose& pose) {
        const float angle = angle_between(pose.target - root, *pose.pole - root);
        return std::min(angle, glm::pi<float>() - angle);
    };
    return {glm::dot(was, is) < 0.0f, std::min(off(before), off(after)) < close};
}

bool was_straight(const ReachPose& before, const ReachPose& after, float reach) {
    return std::min(bend(before.joints), bend(after.joints)) < straight * reach;
}

}  // namespace tendril::app
