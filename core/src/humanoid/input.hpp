// Checks of the input of a body's solvers: maps and poses. Not installed.
#pragma once

#include <cmath>
#include <span>
#include <string_view>

#include "rig/checks.hpp"
#include "tendril/humanoid/bone_map.hpp"

namespace tendril::humanoid::detail {

/// check(), with `operation` in the error message.
Result check_map(std::string_view operation, const BoneMap& map, const Skeleton& skeleton) noexcept;

/// BoneMap::is_usable(), with the missing bone in the error message.
Result check_usable(std::string_view operation, const BoneMap& map) noexcept;

/// The error for a node that is mapped to `bone` but is not below the hips.
Result not_below_hips(const Skeleton& skeleton, std::size_t node, Bone bone) noexcept;

/// The map, or an empty one if check_map() refuses it.
const BoneMap& map_or_none(const BoneMap& map, const Skeleton& skeleton) noexcept;

/// True if each number is finite and at most max_magnitude in magnitude.
inline bool is_within(const glm::dvec3& v) noexcept {
    const auto most = static_cast<double>(max_magnitude);
    return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}

/// Numbers up to max_magnitude, and rotations of length 0.5 to 2, since interpolated ones are not exactly
/// unit.
inline bool is_sane(const rig::Transform& local) noexcept {
    const glm::dquat& q = local.rotation;
    const double squared = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    return is_within(local.translation) && is_within(local.scale) && squared >= 0.25 && squared <= 4.0;
}
/// Index of the first transform that is not sane; pose.size() if all are.
inline std::size_t first_invalid(std::span<const rig::Transform> pose) noexcept {
    std::size_t i = 0;
    while (i < pose.size() && is_sane(pose[i])) ++i;
    return i;
}
inline bool is_sane(std::span<const rig::Transform> pose) noexcept {
    return first_invalid(pose) == pose.size();
}

/// Refuses a pose of another skeleton, or with a transform that is not sane.
inline Result check_pose(std::string_view operation, std::span<const rig::Transform> pose,
                         std::size_t nodes) noexcept {
    if (pose.size() != nodes) return tendril::detail::refused_count(operation, "pose", pose.size(), nodes);
    const std::size_t invalid = first_invalid(pose);
    if (invalid == nodes) return {};
    return tendril::detail::refused(operation, {"pose", invalid}, "finite, at most 1e9, with a unit rotation",
                                    "one that is not");
}
/// Refuses bones so long or short that the solver's numbers would not be finite.
inline Result refused_bones(std::string_view operation) noexcept {
    return tendril::detail::refused(operation, "pose", "one whose bones have usable lengths", "others");
}

/// Refuses a quaternion that cannot be normalised.
inline Result check_rotation(std::string_view operation, const tendril::detail::Argument& argument,
                             const glm::dquat& q) noexcept {
    const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (size > 1e-6 && size <= static_cast<double>(max_magnitude)) return {};
    return tendril::detail::refused(operation, argument, "a rotation",
                                    tendril::detail::Shown("a quaternion of length ", size));
}

}  // namespace tendril::humanoid::detail
