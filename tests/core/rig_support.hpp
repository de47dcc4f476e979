// Shared by rig tests: pseudo-random transforms, and distances between them.
#pragma once

#include <gtest/gtest.h>

#include <cstring>

#include "random.hpp"
#include "tendril/rig/hierarchy.hpp"

namespace tendril::test {

inline constexpr double pi = 3.14159265358979323846;

inline double some_double(Random& random, double range) {
    return (static_cast<double>(random.below(1u << 21)) / 1048576.0 - 1.0) * range;
}
inline glm::dvec3 some_vector(Random& random, double range) {
    const double x = some_double(random, range), y = some_double(random, range);
    const double z = some_double(random, range);
    return {x, y, z};
}
inline glm::dquat some_rotation(Random& random) {
    const double w = some_double(random, 1.0), x = some_double(random, 1.0);
    const double y = some_double(random, 1.0), z = some_double(random, 1.0);
    return rig::normalised({w, x, y, z});
}
/// A factor of magnitude 0.5 to 2, of either sign.
inline double some_factor(Random& random) {
    const double size = std::exp2(some_double(random, 1.0));
    return random.chance(6) ? -size : size;
}
/// Half of them scaled, some uniformly, some not.
inline rig::Transform some_transform(Random& random, double range = 2.0) {
    rig::Transform made{.translation = some_vector(random, range), .rotation = some_rotation(random)};
    if (random.chance(4)) {
        const double x = some_factor(random), y = some_factor(random), z = some_factor(random);
        made.scale = {x, y, z};
    } else if (random.chance(3)) {
        const double size = some_factor(random);
        made.scale = {size, size, size};
    }
    return made;
}

inline double norm(const glm::dvec3& v) {
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}
inline double norm(const glm::dquat& q) {
    return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
}
inline double distance(const glm::dvec3& a, const glm::dvec3& b) {
    return norm(glm::dvec3{a.x - b.x, a.y - b.y, a.z - b.z});
}
/// Distance between rotations, not quaternions: 0 for q and -q.
inline double distance(const glm::dquat& a, const glm::dquat& b) {
    const double minus = norm(glm::dquat{a.w - b.w, a.x - b.x, a.y - b.y, a.z - b.z});
    const double plus = norm(glm::dquat{a.w + b.w, a.x + b.x, a.y + b.y, a.z + b.z});
    return std::min(minus, plus);
}
/// The maximum distance of translation, rotation and scale; relative for translation and scale above 1.
inline double distance(const rig::Transform& a, const rig::Transform& b) {
    return std::max({distance(a.translation, b.translation) / std::max(1.0, norm(b.translation)),
                     distance(a.rotation, b.rotation),
                     distance(a.scale, b.scale) / std::max(1.0, norm(b.scale))});
}

inline bool same_bits(const rig::Transform& a, const rig::Transform& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}
inline bool is_finite(const rig::Transform& transform) {
    double numbers[10];
    std::memcpy(numbers, &transform, sizeof numbers);
    return std::all_of(std::begin(numbers), std::end(numbers),
                       [](double each) { return std::isfinite(each); });
}
inline glm::dquat about(const glm::dvec3& axis, double degrees) {
    const double half = degrees * pi / 360.0, s = std::sin(half);
    return {std::cos(half), axis.x * s, axis.y * s, axis.z * s};
}
inline rig::Transform moved(double x, double y, double z) {
    return {.translation = {x, y, z}};
}

}  // namespace tendril::test
