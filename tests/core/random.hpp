// Pseudo-random numbers that are the same on every platform, unlike the standard library's distributions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace tendril::test {

/// SplitMix64 (Steele, Lea, Flood 2014): any seed works.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// An integer, 0 <= result < count.
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits() % count); }
    bool chance(std::size_t one_in) { return below(one_in) == 0; }
    /// A number from -range to range, in steps of 2^-20 of it; exact if `range` is a power of two.
    float around(float range) {
        return (static_cast<float>(below(1u << 21)) - 1048576.0f) * (1.0f / 1048576.0f) * range;
    }
    /// A number from 0 to 1.
    float part() { return std::abs(around(1.0f)); }
    glm::vec3 point(float range) {
        const float x = around(range), y = around(range), z = around(range);
        return {x, y, z};
    }

  private:
    std::uint64_t state_;
};

}  // namespace tendril::test
