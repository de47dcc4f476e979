// Well-known linkages from named lengths, in metres, for tests, benchmarks and presets. Planar ones are
// sketches (see linkage_from()). Each is drawn closed, with its driver at 0 if the linkage closes there and
// is not flat, otherwise where the struct says. Zero lengths and lengths that do not close as drawn are
// refused by name.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "tendril/ik/linkage.hpp"
#include "tendril/ik/linkage_sketch.hpp"

namespace tendril::ik {

/// Fixed pivots A at the origin and D on +X; B at the end of the crank, C where coupler and rocker meet,
/// above the line from B to D. P moves with the coupler: `coupler_point` is in the coupler's frame, from B,
/// first coordinate towards C. Driver `crank`, 0 along +X.
struct FourBar {
    double ground = 3.0, crank = 1.0, coupler = 2.5, rocker = 2.0;
    glm::dvec2 coupler_point{1.25, 0.8};
};
Expected<LinkageSketch> four_bar(const FourBar& lengths = {});

/// Crank at the origin, with B at its end; the slider S moves along the line y = offset, on the side of +X.
struct SliderCrank {
    double crank = 1.0, rod = 3.0, offset = 0.0;
};
Expected<LinkageSketch> slider_crank(const SliderCrank& lengths = {});

/// A. Peaucellier, 1864: P moves on a straight line, x = (long_bar^2 - short_bar^2) / (2 crank). O at the
/// origin, Q at {crank, 0}; A and B at the ends of the long bars, C on the circle about Q. Driver `crank`.
struct Peaucellier {
    double long_bar = 3.0, short_bar = 1.2, crank = 1.0;
};
Expected<LinkageSketch> peaucellier(const Peaucellier& lengths = {});

/// O is fixed; P copies the motion of T, `scale` times as large. Two degrees of freedom, no driver.
struct Pantograph {
    double arm = 1.0;  ///< from O to the elbow A, and from the elbow to P
    double scale = 2.0;
};
Expected<LinkageSketch> pantograph(const Pantograph& lengths = {});

/// `stages` crosses of two bars each: L0 is fixed, R0 slides along +X from it, the top points are L<stages>
/// and R<stages>. Driver `lift`, the angle of the first bar from +X.
struct ScissorLift {
    std::size_t stages = 3;  ///< 1 to 32
    double bar = 1.0;
    double angle = 0.6;  ///< value of `lift` as drawn, radians, over 0 to pi / 2
};
Expected<LinkageSketch> scissor_lift(const ScissorLift& lengths = {});

/// T. Jansen's leg, with his names for the lengths. The motor's axis is the origin, the other pivot at {-a,
/// -l}. Points crank, upper, lower, back, knee, foot; driver `motor`.
struct Jansen {
    double a = 38.0, b = 41.5, c = 39.3, d = 40.1, e = 55.8, f = 39.4, g = 36.7, h = 65.7, i = 49.0, j = 50.0,
           k = 61.9, l = 7.8, m = 15.0;
};
Expected<LinkageSketch> jansen(const Jansen& lengths = {});

/// R. Clavel's delta robot, 1988: base in z = 0, the platform hangs along -Z; arm i turns in the vertical
/// plane at 120 i degrees about Z. Forearms are pairs of parallel bars, `width` apart, which keep the
/// platform level. Drivers motor_0 to motor_2, radians below the base's plane. Point platform; also elbow_0
/// to elbow_2 and wrist_0 to wrist_2. Drawn with its motors at 30 degrees.
struct Delta {
    double base_radius = 0.2, platform_radius = 0.05, upper_arm = 0.2, forearm = 0.5;
    double width = 0.06;
};
Expected<Linkage> delta(const Delta& lengths = {});
/// The motors' angles for a position of the platform, in closed form, elbows outward. nullopt if out of
/// reach.
std::optional<std::array<double, 3>> delta_motors(const Delta& lengths, const glm::dvec3& platform) noexcept;

/// A platform on six legs (V. Gough 1954, D. Stewart 1965): base in z = 0, platform above it. Legs 2k and 2k
/// + 1 stand on the base at 120 k degrees -+ base_angle and lean apart: their tops are at 120 k degrees -+
/// (60 degrees - platform_angle). Drivers leg_0 to leg_5, the legs' lengths. Point platform, its centre; also
/// base_0..., top_0...
struct Stewart {
    double base_radius = 1.0, platform_radius = 0.6, height = 1.0;  ///< height as drawn
    double base_angle = 0.25, platform_angle = 0.25;                ///< half the angle of a pair, radians
    double minimum = 0.5, maximum = 2.0;                            ///< lengths of the legs
};
Expected<Linkage> stewart(const Stewart& lengths = {});
/// The legs' lengths for a position and rotation of the platform, in closed form.
std::array<double, 6> stewart_legs(const Stewart& lengths, const glm::dvec3& platform,
                                   const glm::dquat& rotation) noexcept;

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::FourBar>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::SliderCrank>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Peaucellier>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Pantograph>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::ScissorLift>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Jansen>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Delta>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Stewart>() noexcept;
