#include "app/labs/rig/walk.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace tendril::app {
namespace {

using Path = Motion::Path;

/// Around the path, in radians. Rounds are whole ticks long, so that the angle never drifts.
double angle_after(const Motion& motion, double ticks) {
    const double rounds =
        (static_cast<double>(motion.ticks) + ticks) / static_cast<double>(ticks_per_round(motion));
    return glm::two_pi<double>() * (rounds - std::floor(rounds));
}

/// In a circle of radius 1, and which way it goes there.
struct Step {
    glm::dvec3 at{0.0}, along{0.0, 0.0, 1.0};
};
Step step_at(Path path, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    switch (path) {
        case Path::Still:
            break;
        case Path::Circle:
            return {{c, 0.0, s}, {-s, 0.0, c}};
        case Path::FigureEight:
            return {{c, 0.0, s * c}, {-s, 0.0, c * c - s * s}};
        case Path::Sweep:
            return {{s, 0.0, 0.0}, {c < 0.0 ? -1.0 : 1.0, 0.0, 0.0}};
    }
    return {};
}

}  // namespace

bool can_walk(rig::ControlKind kind) {
    return kind == rig::ControlKind::Transform || kind == rig::ControlKind::Position;
}

glm::dvec3 walk_point(const Motion& motion, double ticks) {
    return glm::dvec3(motion.centre) +
           static_cast<double>(motion.radius) * step_at(motion.path, angle_after(motion, ticks)).at;
}

rig::Value walk_value(const RigWalk& walk, const rig::Value& now, double ticks) {
    const glm::dvec3 at = walk_point(walk.motion, ticks);
    const auto* pose = std::get_if<rig::Transform>(&now);
    if (!pose) return at;
    rig::Transform to{at, pose->rotation, pose->scale};
    if (walk.turn) {
        const glm::dvec3 along = step_at(walk.motion.path, angle_after(walk.motion, ticks)).along;
        const double half = 0.5 * std::atan2(along.x, along.z);
        to.rotation = glm::dquat(std::cos(half), 0.0, std::sin(half), 0.0);
    }
    return to;
}

}  // namespace tendril::app
