// Exponential, sine, cosine, arctangent and random numbers in plain arithmetic, because the standard
// library's differ between systems, and sometimes between processors. Functions are accurate to 1e-15 of the
// result. Not installed.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace tendril::math {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double ln2 = 0.693147180559945309417;

namespace detail {
/// Adding and subtracting this rounds a double under 2^51 to a whole number.
inline constexpr double rounder = 6755399441055744.0;  // 1.5 * 2^52
}  // namespace detail

/// e^-x for x >= 0; 0 from 708 on, and for NaN.
static inline double decay(double x) noexcept {
    if (!(x < 708.0)) return 0.0;
    // e^-x = 2^-k e^-r with |r| <= ln 2 / 2; e^-r by its power series. ln 2 is subtracted in two parts, the
    // first with so few bits that its products with k are exact.
    constexpr double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 0x1.a39ef35793c76p-33;
    const double k = (x * (1.0 / ln2) + detail::rounder) - detail::rounder;
    const double r = (x - k * ln2_high) - k * ln2_low;
    double sum = 1.0;
    for (int n = 13; n > 0; --n) sum = 1.0 - (r * (1.0 / n)) * sum;
    return sum * std::bit_cast<double>(static_cast<std::uint64_t>(1023 - static_cast<std::int64_t>(k)) << 52);
}

/// SplitMix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", 2014): 64
/// random bits, and the state for the next.
static inline std::uint64_t random_bits(std::uint64_t& state) noexcept {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

struct SineCosine {
    double sine, cosine;
};
/// Sine and cosine of an angle in full turns; whole turns are removed exactly. From 1e14 turns on, and for
/// NaN, the angle is taken as 0.
static inline SineCosine sine_cosine(double turns) noexcept {
    if (!(std::abs(turns) < 1e14)) return {0.0, 1.0};
    const double quarters = (4.0 * turns + detail::rounder) - detail::rounder;
    const double r = 2.0 * pi * (turns - 0.25 * quarters), square = r * r;  // |r| <= pi / 4
    double sine = 1.0, cosine = 1.0;
    for (int n = 16; n > 0; n -= 2) {
        cosine = 1.0 - (square * (1.0 / (n * (n - 1)))) * cosine;
        sine = 1.0 - (square * (1.0 / (n * (n + 1)))) * sine;
    }
    sine *= r;
    switch (static_cast<std::int64_t>(quarters) & 3) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

/// The angle of the point (x, y) from the x axis, radians, -pi to pi; 0 for the origin.
static inline double arctangent(double y, double x) noexcept {
    const double across = std::abs(y), along = std::abs(x);
    const bool steep = across > along;
    if (across == 0.0 && along == 0.0) return 0.0;
    // Halves the angle three times, then uses the power series for arguments up to tan(pi / 32).
    double t = steep ? along / across : across / along;
    for (int i = 0; i < 3; ++i) t = t / (1.0 + std::sqrt(1.0 + t * t));
    constexpr double coefficients[]{1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11, 1.0 / 9,
                                    1.0 / 7,  1.0 / 5,  1.0 / 3,  1.0};
    const double square = t * t;
    double sum = 0.0;
    for (const double each : coefficients) sum = each - square * sum;
    double angle = 8.0 * t * sum;
    if (steep) angle = 0.5 * pi - angle;
    if (x < 0.0) angle = pi - angle;
    return y < 0.0 ? -angle : angle;
}

}  // namespace tendril::math
