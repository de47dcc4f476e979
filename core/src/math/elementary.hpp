// Elementary functions and random numbers in plain arithmetic, because those of the standard library differ
// between systems, and sometimes between processors. Errors are below 1 unit in the last place, for huge and
// subnormal arguments too. Not installed.
#pragma once

#include <cstdint>

namespace tendril::math {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double ln2 = 0.693147180559945309417;

/// e^-x for x >= 0; 0 from 708 on, and for NaN.
double decay(double x) noexcept;

struct SineCosine {
    double sine, cosine;
};
/// Sine and cosine of an angle in radians; one that is not finite counts as 0.
SineCosine sine_cosine(double radians) noexcept;
double sine(double radians) noexcept;
double cosine(double radians) noexcept;
float sine(float radians) noexcept;
float cosine(float radians) noexcept;
/// Sine and cosine of an angle in full turns. From 1e14 turns on, and for NaN, it counts as 0.
SineCosine sine_cosine_of_turns(double turns) noexcept;

/// The angle of the point (x, y) from the x axis, radians, -pi to pi; 0 for the origin. -0 counts as 0.
double arctangent(double y, double x) noexcept;
float arctangent(float y, float x) noexcept;

/// SplitMix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", 2014): 64
/// random bits, and the state for the next.
inline std::uint64_t random_bits(std::uint64_t& state) noexcept {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

}  // namespace tendril::math
