#include "ik/solve/rotations.hpp"

#include <cfloat>

#include "ik/math.hpp"

namespace tendril::ik::detail {
namespace {

/// `q` turned on by the minimal rotation from the unit vector `from` to the direction of `bone`, of `size`.
glm::quat transported(const glm::quat& q, const glm::vec3& from, const glm::vec3& bone, float size) noexcept {
    const float w = size + dot(from, bone);
    const glm::vec3 axis = w < 1e-6f * size ? perpendicular(from) : cross(from, bone);
    const glm::quat minimum{w < 1e-6f * size ? 0.0f : w, axis.x, axis.y, axis.z};
    const glm::quat turned = compose(minimum, q);
    return unit_quaternion(turned.w, turned.x, turned.y, turned.z);
}

}  // namespace

void transport_rotations(Problem& problem) noexcept {
    constexpr float agrees = 1e-10f;  ///< square of the sine of the angle that is rounding
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        glm::quat& rotation = problem.state.rotations[i];
        const glm::vec3 before = rotated(rotation, problem.scratch.rest_directions[i]);
        const glm::vec3 bone = minus(problem.joints[i + 1], problem.joints[i]);
        const float squared = dot(bone, bone);
        if (!(squared > FLT_MIN)) continue;  // no direction
        const glm::vec3 off = cross(before, bone);
        if (dot(off, off) <= agrees * squared && dot(before, bone) > 0.0f) continue;
        rotation = transported(rotation, before, bone, std::sqrt(squared));
    }
}

}  // namespace tendril::ik::detail
