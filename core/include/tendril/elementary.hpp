// Elementary functions in plain arithmetic. The standard library's differ between systems, and sometimes
// between processors; these give the same bits everywhere, so a target or an angle that a game computes with
// them replays exactly. Errors are below 1 unit in the last place, for huge and subnormal arguments too, but
// for the arccosine.
#pragma once

#include "tendril/quat.hpp"
#include "tendril/vec3.hpp"

namespace tendril::math {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double ln2 = 0.693147180559945309417;

/// e^x; 0 for x <= -708, infinity for x > 709, and NaN for NaN.
double exponential(double x) noexcept;
/// e^-x for x >= 0; 0 from 708 on, and for NaN.
double decay(double x) noexcept;
/// The natural logarithm; -infinity for 0, NaN below 0.
double logarithm(double x) noexcept;

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
/// Radians, 0 to pi, to 5e-16. A cosine beyond -1 to 1 counts as the nearer of them.
double arccosine(double cosine) noexcept;

/// Rotation about a unit axis, radians.
glm::quat rotation_about(const glm::vec3& axis, float radians) noexcept;
glm::dquat rotation_about(const glm::dvec3& axis, double radians) noexcept;

}  // namespace tendril::math
