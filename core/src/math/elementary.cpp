#include "tendril/elementary.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace tendril::math {
namespace {

/// A value and its rounding error.
struct Sum {
    double value, rest = 0.0;
};

/// Exact (D. Knuth, "The Art of Computer Programming", volume 2, 4.2.2).
inline Sum add(double a, double b) {
    const double sum = a + b, part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
}
inline Sum add(Sum a, Sum b) {
    const Sum sum = add(a.value, b.value);
    return {sum.value, sum.rest + (a.rest + b.rest)};
}

/// The leading 26 bits, so that products of two such parts are exact (T. Dekker, 1971); magnitudes under
/// 2^996.
inline double leading(double a) {
    const double scaled = 134217729.0 * a;  // 2^27 + 1
    return scaled - (scaled - a);
}
/// Exact, unless the remainder underflows.
inline Sum multiply(double a, double b) {
    const double product = a * b, a1 = leading(a), a2 = a - a1, b1 = leading(b), b2 = b - b1;
    return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

/// Adding and subtracting this rounds a double under 2^51 to a whole number.
constexpr double rounder = 6755399441055744.0;  // 1.5 * 2^52
constexpr Sum half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

inline Sum half_pi_times(Sum part) {
    const Sum angle = multiply(half_pi.value, part.value);
    return add(angle.value, angle.rest + (half_pi.value * part.rest + half_pi.rest * part.value));
}

// Sine and cosine up to pi / 4: minimax polynomials, found by Remez' exchange; relative errors 2^-57 and
// 2^-62.

inline double small_sine(Sum angle) {
    const double r = angle.value, z = r * r, zz = z * z;
    const double high = (0x1.71de356f10fb5p-19 + z * -0x1.ae5e4c07395e1p-26) + zz * 0x1.5d875b9d4c1a2p-33;
    const double low = (-0x1.555555555554dp-3 + z * 0x1.111111110fb4dp-7) + zz * -0x1.a01a019c3050bp-13;
    return r + (r * z * (low + z * zz * high) + angle.rest * (1.0 - 0.5 * z));
}
inline double small_cosine(Sum angle) {
    const double r = angle.value, z = r * r, zz = z * z, half = 0.5 * z, rough = 1.0 - half;
    const double high = (-0x1.27e4f903dba05p-22 + z * 0x1.1eea8935afc8fp-29) + zz * -0x1.8ff9c523984f2p-37;
    const double low = (0x1.5555555555553p-5 + z * -0x1.6c16c16c16132p-10) + zz * 0x1.a01a019e24bc8p-16;
    return rough + (((1.0 - rough) - half) + (zz * (low + z * zz * high) - r * angle.rest));
}

/// An angle of at most pi / 4, plus `quarters` right angles.
struct Reduced {
    Sum angle;
    std::int64_t quarters = 0;

    double sine() const {
        const double size = (quarters & 1) != 0 ? small_cosine(angle) : small_sine(angle);
        return (quarters & 2) != 0 ? -size : size;
    }
    double cosine() const { return Reduced{angle, quarters + 1}.sine(); }
};

/// For a finite angle of 2^20 or more (M. Payne, R. Hanek, "Radian reduction for trigonometric functions",
/// 1983): its 53 bits times the 192 bits of 2 / pi that determine the quarter turn and the position in it.
Reduced reduce_huge(double radians) {
    static constexpr std::uint32_t two_over_pi[]{
        0,           0,           0xa2f9836eu, 0x4e441529u, 0xfc2757d1u, 0xf534ddc0u, 0xdb629599u,
        0x3c439041u, 0xfe5163abu, 0xdebbc561u, 0xb7246e3au, 0x424dd2e0u, 0x06492eeau, 0x09d1921cu,
        0xfe1deb1cu, 0xb129a73eu, 0xe88235f5u, 0x2ebb4484u, 0xe99c7026u, 0xb45f7e41u, 0x3991d639u,
        0x835339f4u, 0x9c845f8bu, 0xbdf9283bu, 0x1ff897ffu, 0xde05980fu, 0xef2f118bu, 0x5a0a6d1fu,
        0x6d367ecfu, 0x27cb09b7u, 0x4f463f66u, 0x9e5fea2du, 0x7527bac7u, 0xebe5f17bu, 0x3d0739f7u,
        0x8a5292eau, 0x6bfb5fb1u, 0x1f8d5d08u, 0x56033046u, 0xfc7b6babu};
    const auto bits = std::bit_cast<std::uint64_t>(radians);
    const int exponent = static_cast<int>(bits >> 52 & 0x7ff) - 1075;
    const std::uint64_t digits = (bits & ((std::uint64_t{1} << 52) - 1)) | std::uint64_t{1} << 52;
    // The table starts 64 bits before the point. Only the last two bits that count whole turns are kept.
    const int first = exponent + 62, word = first / 32, shift = first % 32;
    const auto part = [&](int k) {
        const std::uint64_t next = shift > 0 ? two_over_pi[word + k + 1] : 0u;
        return (std::uint64_t{two_over_pi[word + k]} << 32 | next) << shift >> 32;
    };
    std::uint32_t product[6]{};  // lowest first; 2 bits before the point, 190 after it
    std::uint64_t carry = 0;
    for (int i = 0; i < 6; ++i) {
        const std::uint64_t low = part(5 - i) * (digits & 0xffffffffu);
        const std::uint64_t high = i > 0 ? part(6 - i) * (digits >> 32) : 0;
        const std::uint64_t sum = carry + (low & 0xffffffffu) + (high & 0xffffffffu);
        product[i] = static_cast<std::uint32_t>(sum);
        carry = (sum >> 32) + (low >> 32) + (high >> 32);
    }
    const bool past_half = (product[5] & 0x20000000u) != 0;
    const std::int64_t quarters = (product[5] >> 30) + (past_half ? 1 : 0);
    product[5] &= 0x3fffffffu;
    Sum place{past_half ? -1.0 : 0.0};
    double unit = 0x1p-30;
    for (int i = 5; i >= 0; --i, unit *= 0x1p-32) {
        place = add(place, {unit * product[i]});
        place = add(place.value, place.rest);
    }
    const Sum angle = half_pi_times(place);
    return radians < 0.0 ? Reduced{{-angle.value, -angle.rest}, -quarters} : Reduced{angle, quarters};
}

inline Reduced reduce(double radians) {
    const double size = std::abs(radians);
    if (size <= 0.5 * half_pi.value) return {{radians}};
    if (!(size < 0x1p20)) return std::isfinite(radians) ? reduce_huge(radians) : Reduced{{0.0}};
    // pi / 2 in four parts; the products of the first three with whole numbers under 2^20 are exact
    // (W. Cody, W. Waite, "Software Manual for the Elementary Functions", 1980).
    const double quarters = (radians * (1.0 / half_pi.value) + rounder) - rounder;
    Sum left = add(radians - quarters * 0x1.921fb54400000p+0, -quarters * 0x1.0b4611a600000p-34);
    left = add(left, {-quarters * 0x1.3198a2e000000p-69});
    if (std::abs(left.value) < 0x1p-20) left = add(left, {-quarters * 0x1.b839a252049c1p-104});
    return {left, static_cast<std::int64_t>(quarters)};
}

/// For floats: power series, to 3e-9.
inline float sine_of(float radians, std::int64_t more_quarters) {
    const double wide = radians;
    if (!(std::abs(wide) < 0x1p20)) {
        const Reduced angle = reduce(wide);
        return static_cast<float>(Reduced{angle.angle, angle.quarters + more_quarters}.sine());
    }
    const double quarters = (wide * (1.0 / half_pi.value) + rounder) - rounder;
    const double r = (wide - quarters * 0x1.921fb54400000p+0) - quarters * 0x1.0b4611a626331p-34;
    const double z = r * r, zz = z * z;
    const std::int64_t number = static_cast<std::int64_t>(quarters) + more_quarters;
    const double size =
        (number & 1) != 0
            ? ((1.0 - 0.5 * z) + zz * (1.0 / 24 - z * (1.0 / 720))) +
                  zz * zz * (1.0 / 40320 - z * (1.0 / 3628800))
            : r * ((1.0 - z * (1.0 / 6)) + zz * ((1.0 / 120 - z * (1.0 / 5040)) + zz * (1.0 / 362880)));
    return static_cast<float>((number & 2) != 0 ? -size : size);
}

/// Reduced to the nearest c = k / 8: atan(q) = atan(c) + atan((q - c) / (1 + c q)); the rest by its power
/// series.
template <bool exact>
double angle_of(double y, double x) {
    static constexpr Sum eighths[]{{0.0, 0.0},
                                   {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                   {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                   {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                   {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                   {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                   {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                   {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                   {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
    if (std::isnan(x) || std::isnan(y)) return x + y;
    double across = std::abs(y), along = std::abs(x);
    const bool steep = across > along;
    if (steep) std::swap(across, along);
    if (along == 0.0) return 0.0;
    if constexpr (exact) {
        if (!(along < 0x1p900)) {
            if (std::isinf(along)) across = std::isinf(across) ? 0x1p900 : 0.0, along = 0x1p900;
            across *= 0x1p-200, along *= 0x1p-200;
        }
        if (along < 0x1p-400) across *= 0x1p600, along *= 0x1p600;
    } else if (std::isinf(along)) {
        across = std::isinf(across) ? 1.0 : 0.0, along = 1.0;
    }
    const double k = (8.0 * across / along + rounder) - rounder, c = 0.125 * k;
    const double high = exact ? leading(along) : along;  // so that c * high is exact
    const double above = (across - c * high) - c * (along - high), below = along + c * across,
                 t = above / below;
    const double z = t * t, zz = z * z;
    const double series = ((1.0 / 3 - z * (1.0 / 5)) + zz * (1.0 / 7 - z * (1.0 / 9))) +
                          zz * zz * ((1.0 / 11 - z * (1.0 / 13)) + zz * (1.0 / 15));
    Sum angle{t, -t * z * series};
    if (exact && k < 2.0 && above * above > 0x1p-1000) {
        // Here t is most of the result, so add the rounding errors of the division and its operands.
        const Sum product = multiply(t, below);
        const double rounded = (along - below) + c * across;
        angle.rest += (((above - product.value) - product.rest) - t * rounded) / below;
    }
    angle = add(eighths[static_cast<int>(k)], angle);
    if (steep) angle = add(half_pi, {-angle.value, -angle.rest});
    if (x < 0.0) angle = add({2.0 * half_pi.value, 2.0 * half_pi.rest}, {-angle.value, -angle.rest});
    const double result = angle.value + angle.rest;
    return y < 0.0 ? -result : result;
}

}  // namespace

double exponential(double x) noexcept {
    if (x > 709.0) return std::numeric_limits<double>::infinity();
    return std::isnan(x) ? x : decay(-x);
}

double decay(double x) noexcept {
    if (!(x < 708.0)) return 0.0;
    // e^-x = 2^-(n / 8) e^-r with |r| <= ln 2 / 16; e^-r by its power series. The products of the first part
    // of ln 2 / 8 with n are exact.
    static constexpr Sum powers[]{{0x1.0000000000000p+0, 0.0},
                                  {0x1.d5818dcfba487p-1, 0x1.2ed02d75b3707p-56},
                                  {0x1.ae89f995ad3adp-1, 0x1.7a1cd345dcc81p-55},
                                  {0x1.8ace5422aa0dbp-1, 0x1.6e9f156864b27p-55},
                                  {0x1.6a09e667f3bcdp-1, -0x1.bdd3413b26456p-55},
                                  {0x1.4bfdad5362a27p-1, 0x1.d4397afec42e2p-57},
                                  {0x1.306fe0a31b715p-1, 0x1.6f46ad23182e4p-56},
                                  {0x1.172b83c7d517bp-1, -0x1.19041b9d78a76p-56}};
    const double n = (x * (8.0 / ln2) + rounder) - rounder;
    const double r = (x - n * 0x1.62e42fefa0000p-4) - n * 0x1.cf79abc9e3b3ap-43, rr = r * r;
    const double high = (1.0 / 720 - r * (1.0 / 5040)) + rr * (1.0 / 40320);
    const double less = rr * ((0.5 - r * (1.0 / 6)) + rr * ((1.0 / 24 - r * (1.0 / 120)) + rr * high)) - r;
    const auto eighths = static_cast<std::int64_t>(n);
    const auto [power, rest] = powers[eighths & 7];
    return (power + (power * less + rest)) *
           std::bit_cast<double>(static_cast<std::uint64_t>(1023 - (eighths >> 3)) << 52);
}

double logarithm(double x) noexcept {
    constexpr double infinity = std::numeric_limits<double>::infinity(),
                     least = std::numeric_limits<double>::min();
    if (!(x >= least && x < infinity)) {
        if (x > 0.0 && x < least) return logarithm(x * 0x1p54) - 54.0 * ln2;
        return x == infinity ? x : x == 0.0 ? -infinity : std::numeric_limits<double>::quiet_NaN();
    }
    // ln x = n ln 2 + ln(1 + f), with 1 + f from sqrt(1/2) to sqrt(2); ln(1 + f) = 2 artanh(f / (2 + f)) by
    // its power series. f and n times the first part of ln 2 are exact.
    const auto bits = std::bit_cast<std::uint64_t>(x);
    constexpr auto sqrt_half = std::bit_cast<std::uint64_t>(std::numbers::sqrt2 / 2);
    const std::uint64_t above = bits - sqrt_half;
    const auto powers = static_cast<std::int64_t>(above) >> 52;
    const double n = static_cast<double>(powers);
    const double f = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(powers) << 52)) - 1.0;
    const double s = f / (2.0 + f), half = 0.5 * f * f, z = s * s, zz = z * z, z4 = zz * zz;
    const double low = (2.0 / 3 + z * (2.0 / 5)) + zz * (2.0 / 7 + z * (2.0 / 9));
    const double high = (2.0 / 11 + z * (2.0 / 13)) + zz * (2.0 / 15 + z * (2.0 / 17));
    const double series = z * (low + z4 * (high + z4 * (2.0 / 19 + z * (2.0 / 21))));
    return n * 0x1.62e42fee00000p-1 + (f - (half - (s * (half + series) + n * 0x1.a39ef35793c76p-33)));
}

SineCosine sine_cosine(double radians) noexcept {
    const Reduced angle = reduce(radians);
    return {angle.sine(), angle.cosine()};
}
double sine(double radians) noexcept {
    return reduce(radians).sine();
}
double cosine(double radians) noexcept {
    return reduce(radians).cosine();
}
float sine(float radians) noexcept {
    return sine_of(radians, 0);
}
float cosine(float radians) noexcept {
    return sine_of(radians, 1);
}

SineCosine sine_cosine_of_turns(double turns) noexcept {
    if (!(std::abs(turns) < 1e14)) return {0.0, 1.0};
    const double quarters = (4.0 * turns + rounder) - rounder;
    const Reduced angle{half_pi_times({4.0 * turns - quarters}), static_cast<std::int64_t>(quarters)};
    return {angle.sine(), angle.cosine()};
}

double arctangent(double y, double x) noexcept {
    return angle_of<true>(y, x);
}
float arctangent(float y, float x) noexcept {
    return static_cast<float>(angle_of<false>(y, x));
}

double arccosine(double cosine) noexcept {
    const double held = cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine;
    return arctangent(std::sqrt((1.0 - held) * (1.0 + held)), held);
}

glm::quat rotation_about(const glm::vec3& axis, float radians) noexcept {
    const float s = sine(0.5f * radians);
    return {cosine(0.5f * radians), axis.x * s, axis.y * s, axis.z * s};
}
glm::dquat rotation_about(const glm::dvec3& axis, double radians) noexcept {
    const SineCosine half = sine_cosine(0.5 * radians);
    return {half.cosine, axis.x * half.sine, axis.y * half.sine, axis.z * half.sine};
}

}  // namespace tendril::math
