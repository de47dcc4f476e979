// Lets one formula work on numbers, vectors and rotations: positions, and displacements between them. A
// rotation is a position; its displacements are rotation vectors. All in double, in plain arithmetic for the
// reason in math/point.hpp. Not installed.
#pragma once

#include <cmath>

#include "math/vector.hpp"
#include "tendril/elementary.hpp"
#include "tendril/quat.hpp"
#include "tendril/signal/input.hpp"
#include "tendril/vec3.hpp"

namespace tendril::signal::detail {

using glm::dquat;
using glm::dvec3;
using math::plus;
using math::times;

static inline double plus(double a, double b) noexcept {
    return a + b;
}
static inline double times(double a, double by) noexcept {
    return a * by;
}

// ---- Conversion to double and back

static inline double wide(double x) noexcept {
    return x;
}
static inline double wide(float x) noexcept {
    return static_cast<double>(x);
}
static inline dvec3 wide(const dvec3& x) noexcept {
    return x;
}
static inline dvec3 wide(const glm::vec3& x) noexcept {
    return math::wide(x);
}
/// Converts to double, and normalises.
static inline dquat wide(const dquat& q) noexcept {
    const double scale = 1.0 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}
static inline dquat wide(const glm::quat& q) noexcept {
    return wide(dquat{static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
                      static_cast<double>(q.z)});
}

/// Clamped to max_output in magnitude; NaN, which nothing here produces, becomes 0.
static inline double bounded(double x) noexcept {
    return x >= -max_output ? (x <= max_output ? x : max_output) : (x < -max_output ? -max_output : 0.0);
}

template <class T>
T narrow(const double& x) noexcept {
    return static_cast<T>(bounded(x));
}
template <class T>
T narrow(const dvec3& x) noexcept {
    using Number = typename T::value_type;
    return {narrow<Number>(x.x), narrow<Number>(x.y), narrow<Number>(x.z)};
}
template <class T>
T narrow(const dquat& q) noexcept {
    using Number = typename T::value_type;
    return T{static_cast<Number>(q.w), static_cast<Number>(q.x), static_cast<Number>(q.y),
             static_cast<Number>(q.z)};
}

// ---- Displacements

/// First `b`, then `a`.
static inline dquat compose(const dquat& a, const dquat& b) noexcept {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// The displacement between two positions; for rotations axis times angle, the short way round.
static inline double displacement(double from, double to) noexcept {
    return to - from;
}
static inline dvec3 displacement(const dvec3& from, const dvec3& to) noexcept {
    return math::minus(to, from);
}
static inline dvec3 displacement(const dquat& from, const dquat& to) noexcept {
    const dquat q = compose(to, {from.w, -from.x, -from.y, -from.z});
    const dvec3 axis{q.x, q.y, q.z};
    const double sine = math::length(axis), cosine = std::abs(q.w);
    const double scale = sine > 1e-12 ? 2.0 * math::arctangent(sine, cosine) / sine : 2.0;
    return times(axis, q.w < 0.0 ? -scale : scale);
}

static inline double moved(double from, double by) noexcept {
    return from + by;
}
static inline dvec3 moved(const dvec3& from, const dvec3& by) noexcept {
    return plus(from, by);
}
static inline dquat moved(const dquat& from, const dvec3& by) noexcept {
    const double angle = math::length(by);
    const math::SineCosine half = math::sine_cosine(0.5 * angle);
    const double scale = angle > 1e-12 ? half.sine / angle : 0.5;
    return wide(compose({half.cosine, by.x * scale, by.y * scale, by.z * scale}, from));
}

/// For rotations the squared difference of their components, the short way round.
static inline double squared_distance(double a, double b) noexcept {
    return (b - a) * (b - a);
}
static inline double squared_distance(const dvec3& a, const dvec3& b) noexcept {
    const dvec3 d = math::minus(b, a);
    return math::dot(d, d);
}
static inline double squared_distance(const dquat& a, const dquat& b) noexcept {
    const double sign = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0.0 ? -1.0 : 1.0;
    const double w = b.w - sign * a.w, x = b.x - sign * a.x, y = b.y - sign * a.y, z = b.z - sign * a.z;
    return w * w + x * x + y * y + z * z;
}

}  // namespace tendril::signal::detail
