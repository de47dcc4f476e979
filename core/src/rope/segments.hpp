// Nearest points of two segments, and of a point and a triangle. Not installed.
#pragma once

#include <algorithm>
#include <array>

#include "rope/geometry.hpp"

namespace tendril::rope::detail {

struct NearestOfSegments {
    double at_a = 0.0, at_b = 0.0;  ///< 0 to 1
    dvec3 between{0.0};             ///< from a's point to b's
};

/// C. Ericson, "Real-Time Collision Detection", 2005, 5.1.9.
inline NearestOfSegments nearest_of_segments(const dvec3& a0, const dvec3& a1, const dvec3& b0,
                                             const dvec3& b1) noexcept {
    const dvec3 u = a1 - a0, v = b1 - b0, r = a0 - b0;
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
    const double apart = uu * vv - uv * uv;
    double s = apart > 1e-12 * uu * vv ? std::clamp((uv * vr - ur * vv) / apart, 0.0, 1.0) : 0.5;
    double t = vv > 0.0 ? (uv * s + vr) / vv : 0.0;
    if (t < 0.0 || t > 1.0 || !(apart > 1e-12 * uu * vv)) {
        t = std::clamp(t, 0.0, 1.0);
        s = uu > 0.0 ? std::clamp((uv * t - ur) / uu, 0.0, 1.0) : 0.0;
    }
    return {s, t, (b0 + t * v) - (a0 + s * u)};
}

/// Barycentric coordinates of the point of a triangle nearest to `p` (Ericson, 5.1.5).
inline std::array<double, 3> nearest_of_triangle(const dvec3& p, const dvec3& a, const dvec3& b,
                                                 const dvec3& c) noexcept {
    const dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double a_b = dot(ab, ap), a_c = dot(ac, ap), b_b = dot(ab, bp), b_c = dot(ac, bp),
                 c_b = dot(ab, cp), c_c = dot(ac, cp);
    if (a_b <= 0.0 && a_c <= 0.0) return {1.0, 0.0, 0.0};
    if (b_b >= 0.0 && b_c <= b_b) return {0.0, 1.0, 0.0};
    if (c_c >= 0.0 && c_b <= c_c) return {0.0, 0.0, 1.0};
    const double of_c = a_b * b_c - b_b * a_c, of_b = c_b * a_c - a_b * c_c, of_a = b_b * c_c - c_b * b_c;
    if (of_c <= 0.0 && a_b >= 0.0 && b_b <= 0.0 && a_b > b_b)
        return {1.0 - a_b / (a_b - b_b), a_b / (a_b - b_b), 0.0};
    if (of_b <= 0.0 && a_c >= 0.0 && c_c <= 0.0 && a_c > c_c)
        return {1.0 - a_c / (a_c - c_c), 0.0, a_c / (a_c - c_c)};
    const double along = b_c - b_b, back = c_b - c_c;
    if (of_a <= 0.0 && along >= 0.0 && back >= 0.0 && along + back > 0.0)
        return {0.0, back / (along + back), along / (along + back)};
    const double sum = of_a + of_b + of_c;
    if (!(sum > 0.0)) return {1.0, 0.0, 0.0};  // corners on a line: threads meet threads there
    return {of_a / sum, of_b / sum, of_c / sum};
}

}  // namespace tendril::rope::detail
