#include "ik/solve/prepare.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#include "ik/math.hpp"

namespace tendril::ik::detail {
namespace {

/// Same tolerance as a Chain: the invariant of chain.hpp plus, further out, the spacing of floats.
bool is_at_length(const glm::vec3& from, const glm::vec3& to, float length) noexcept {
    const double x = static_cast<double>(to.x) - static_cast<double>(from.x);
    const double y = static_cast<double>(to.y) - static_cast<double>(from.y);
    const double z = static_cast<double>(to.z) - static_cast<double>(from.z);
    const double wanted = static_cast<double>(length);
    const double error = std::abs(std::sqrt(x * x + y * y + z * z) - wanted);
    const double allowed = 1e-4 * std::max(1.0, wanted);
    if (error <= allowed) return true;
    const double furthest = std::max<double>(largest_coordinate(from), largest_coordinate(to));
    constexpr auto spacing = static_cast<double>(std::numeric_limits<float>::epsilon());
    return furthest > 1e3 && error <= allowed + furthest * spacing;
}

template <class Watch>
void place(Problem& problem, std::size_t joint, const glm::vec3& to, Watch watch) noexcept {
    watch.moved(0, Phase::Prepare, joint, joint - 1, problem.joints[joint], to);
    watch.next_step();
    problem.joints[joint] = to;
}

/// Applies to `q` the minimal rotation from the unit vector `from` to the direction of `bone`, of length
/// `size`.
glm::quat transported(const glm::quat& q, const glm::vec3& from, const glm::vec3& bone, float size) noexcept {
    const float w = size + dot(from, bone);
    const glm::vec3 axis = w < 1e-6f * size ? perpendicular(from) : cross(from, bone);
    const glm::quat minimum{w < 1e-6f * size ? 0.0f : w, axis.x, axis.y, axis.z};
    const glm::quat turned = compose(minimum, q);
    return unit_quaternion(turned.w, turned.x, turned.y, turned.z);
}

}  // namespace

template <class Watch>
void enforce_lengths(Problem& problem, Watch watch) noexcept {
    const std::span<glm::vec3> joints = problem.joints;
    const std::span<const float> lengths = problem.lengths();
    std::size_t i = 1;
    while (i < joints.size() && is_at_length(joints[i - 1], joints[i], lengths[i - 1])) ++i;
    if (i == joints.size()) return;
    glm::vec3 given_before = joints[i - 1];
    for (; i < joints.size(); ++i) {
        const glm::vec3 given = joints[i], &at = joints[i - 1],
                        &rest = problem.scratch.rest_directions[i - 1];
        const bool shows_direction = !coincide(given_before, given);
        const glm::vec3 fallback = i > 1 ? tendril::math::direction(joints[i - 2], at, rest) : rest;
        place(problem, i, step(at, shows_direction ? given : at, lengths[i - 1], fallback), watch);
        given_before = given;
    }
}

template <class Watch>
void snap_back(Problem& problem, float part, Watch watch) noexcept {
    if (part == 0.0f) return;
    for (std::size_t i = 1; i < problem.joints.size(); ++i) {
        const float length = problem.lengths()[i - 1];
        const glm::vec3 &at = problem.joints[i - 1], &rest = problem.scratch.rest_directions[i - 1];
        const glm::vec3 old = problem.joints[i], resting = moved(at, rest, length);
        place(problem, i, step(at, moved(old, minus(resting, old), part), length, rest), watch);
    }
}

void transport_rotations(Problem& problem) noexcept {
    constexpr float agrees = 1e-10f;  ///< square of the sine of an angle that is rounding
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

template void enforce_lengths(Problem&, Unwatched) noexcept;
template void enforce_lengths(Problem&, Watched) noexcept;
template void snap_back(Problem&, float, Unwatched) noexcept;
template void snap_back(Problem&, float, Watched) noexcept;

}  // namespace tendril::ik::detail
