// Shared by solver tests, without a solver: lengths, poses, and the invariants of every solve.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <numeric>

#include "chain_support.hpp"
#include "random.hpp"

namespace tendril::test {

/// Rodrigues' formula.
inline glm::dvec3 turned(glm::dvec3 v, glm::dvec3 axis, double angle) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * (glm::dot(axis, v) * (1.0 - std::cos(angle)));
}

using Joints = std::vector<glm::vec3>;
using Lengths = std::vector<float>;

inline double reach_of(std::span<const float> lengths) {
    return std::accumulate(lengths.begin(), lengths.end(), 0.0);
}

inline Joints straight_joints(std::span<const float> lengths, glm::vec3 direction = {1, 0, 0},
                              glm::vec3 root = {0, 0, 0}) {
    Joints joints{root};
    for (const float length : lengths) joints.push_back(joints.back() + direction * length);
    return joints;
}

inline glm::vec3 some_direction(Random& random) {
    for (;;) {
        const glm::vec3 p = random.point(1.0f);
        const double size = distance(p, glm::vec3(0.0f));
        if (size > 0.05 && size <= 1.0) return p * static_cast<float>(1.0 / size);
    }
}

/// A random number from 0 to 1.
inline float part(Random& random) {
    return 0.5f + 0.5f * random.around(1.0f);
}

inline float between(Random& random, float least, float most) {
    return least + (most - least) * part(random);
}

/// Evaluated in the same order by every compiler, unlike `some_direction(random) * part(random)`.
inline glm::vec3 some_offset(Random& random, float least, float most) {
    const glm::vec3 direction = some_direction(random);
    return direction * between(random, least, most);
}

inline glm::quat some_turn(Random& random, float largest) {
    const glm::vec3 axis = some_direction(random);
    return glm::angleAxis(random.around(largest), axis);
}

/// Every bone points in a random direction.
inline Joints some_pose(std::span<const float> lengths, Random& random, glm::vec3 root = {0, 0, 0}) {
    Joints joints{root};
    for (const float length : lengths) joints.push_back(joints.back() + some_direction(random) * length);
    return joints;
}

inline Lengths some_lengths(std::size_t bones, Random& random) {
    Lengths lengths(bones);
    for (float& length : lengths) length = between(random, 0.2f, 1.5f);
    return lengths;
}

/// The invariants of chain.hpp, for bare joints.
inline ::testing::AssertionResult Holds(std::span<const glm::vec3> joints, std::span<const float> lengths) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const glm::vec3 p = joints[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return ::testing::AssertionFailure() << "joint " << i << " is not finite";
        if (i == 0) continue;
        const glm::vec3 q = joints[i - 1];
        const double length = lengths[i - 1], off = std::abs(distance(p, q) - length);
        const float far = std::max(
            {std::abs(p.x), std::abs(p.y), std::abs(p.z), std::abs(q.x), std::abs(q.y), std::abs(q.z)});
        double allowed = 1e-4 * std::max(1.0, length);
        if (far > 1e3f / std::sqrt(3.0f)) allowed += static_cast<double>(std::nextafter(far, infinity) - far);
        if (!(off <= allowed))
            return ::testing::AssertionFailure()
                   << "bone " << i - 1 << " of length " << length << " is off by " << off;
    }
    return ::testing::AssertionSuccess();
}

inline bool same_bits(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

}  // namespace tendril::test
