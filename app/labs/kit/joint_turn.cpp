#include "app/labs/kit/joint_turn.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace tendril::app {

JointTurn joint_turn(const glm::dquat& turn, const glm::dvec3& along) {
    // A rotation and its opposite are one turn: the shorter one is told.
    const glm::dquat q = turn.w < 0.0 ? -turn : turn;
    const glm::dvec3 sines(q.x, q.y, q.z);
    const double about = glm::dot(sines, glm::normalize(along));
    const double across = std::sqrt(std::max(0.0, glm::dot(sines, sines) - about * about));
    const double kept = std::hypot(q.w, about);
    JointTurn told;
    told.swing = glm::degrees(2.0 * std::atan2(across, kept));
    told.twist = kept > 1e-12 * glm::length(q) ? glm::degrees(2.0 * std::atan2(about, q.w)) : 0.0;
    told.angle = glm::degrees(2.0 * std::atan2(glm::length(sines), q.w));
    return told;
}

}  // namespace tendril::app
