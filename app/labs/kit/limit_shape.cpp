#include "app/labs/kit/limit_shape.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace tendril::app {

LimitShape::LimitShape(const ik::Limit& limit, glm::vec3 rest, glm::quat parent)
    : limit_(limit), rest_(rest), parent_(parent) {
    up_axis_ = limit.axis - rest * glm::dot(limit.axis, rest);
    up_axis_ = glm::length(up_axis_) > 1e-6f ? glm::normalize(up_axis_) : glm::vec3(0, 0, 1);
    left_axis_ = glm::cross(up_axis_, rest);
}

glm::quat LimitShape::swing(float up, float left) const {
    const glm::vec3 swing = up_axis_ * up + left_axis_ * left;
    const float angle = glm::length(swing);
    return angle < 1e-7f ? glm::quat(1, 0, 0, 0) : glm::angleAxis(angle, swing / angle);
}

glm::vec3 LimitShape::direction(float up, float left) const {
    return parent_ * (swing(up, left) * rest_);
}

std::vector<glm::vec3> LimitShape::outline(int steps) const {
    std::vector<glm::vec3> points;
    for (int i = 0; i <= steps; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(steps);
        if (is_hinge()) {
            points.push_back(direction(limit_.min + (limit_.max - limit_.min) * share, 0.0f));
            continue;
        }
        const float phi = glm::two_pi<float>() * share;
        const float up = std::sin(phi), left = std::cos(phi);
        points.push_back(direction(up * (up > 0.0f ? limit_.up : limit_.down),
                                   left * (left > 0.0f ? limit_.left : limit_.right)));
    }
    return points;
}

glm::vec3 LimitShape::side(const ik::JointAngles& angles) const {
    return parent_ * (swing(angles.up, angles.left) * (glm::angleAxis(angles.twist, rest_) * left_axis_));
}

}  // namespace tendril::app
