// Random numbers that are the same with every standard library.
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>

namespace tendril::test {

class RandomNumbers {
  public:
    explicit RandomNumbers(std::uint32_t seed) : random(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 8) / 16777216.0;
    }
    /// A uniformly distributed unit vector.
    glm::dvec3 direction() {
        for (;;) {
            const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
            const glm::dvec3 way(x, y, z);
            if (const double length = glm::length(way); length > 0.1 && length < 1.0) return way / length;
        }
    }

    std::mt19937 random;
};

}  // namespace tendril::test
