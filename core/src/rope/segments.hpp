// Where two segments are nearest. Not installed.
#pragma once

#include <algorithm>

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

}  // namespace tendril::rope::detail
