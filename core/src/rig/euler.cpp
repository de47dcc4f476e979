#include "tendril/rig/euler.hpp"

#include <cmath>

#include "rig/math.hpp"
#include "tendril/rig/transform.hpp"

namespace tendril::rig {
namespace {

using namespace detail;

/// A difference or sum of two angles in (-pi, pi] brought back into that range.
double wrapped(double angle) noexcept {
    return angle > pi ? angle - 2.0 * pi : angle <= -pi ? angle + 2.0 * pi : angle;
}

}  // namespace

glm::dvec3 to_euler(const glm::dquat& q) noexcept {
    // With the half angles: (w + y, z - x) is cos(y/2) + sin(y/2) times the unit vector at angle (z - x)/2,
    // and (w - y, z + x) is cos(y/2) - sin(y/2) times the one at (z + x)/2.
    const double plus_size = std::sqrt((q.w + q.y) * (q.w + q.y) + (q.z - q.x) * (q.z - q.x));
    const double minus_size = std::sqrt((q.w - q.y) * (q.w - q.y) + (q.z + q.x) * (q.z + q.x));
    const double y = 2.0 * arctangent(plus_size, minus_size) - 0.5 * pi;
    double difference = arctangent(q.z - q.x, q.w + q.y);
    double sum = arctangent(q.z + q.x, q.w - q.y);
    constexpr double pole = 1e-9;
    if (minus_size < pole) sum = -difference;
    if (plus_size < pole) difference = -sum;
    return {wrapped(sum - difference), y, wrapped(sum + difference)};
}

glm::dquat from_euler(const glm::dvec3& angles) noexcept {
    const glm::dquat x = rotation_about(glm::dvec3{1.0, 0.0, 0.0}, angles.x);
    const glm::dquat y = rotation_about(glm::dvec3{0.0, 1.0, 0.0}, angles.y);
    const glm::dquat z = rotation_about(glm::dvec3{0.0, 0.0, 1.0}, angles.z);
    return normalised(math::compose(z, math::compose(y, x)));
}

}  // namespace tendril::rig
