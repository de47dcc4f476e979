// A smooth curve through points, with twist-free frames: the centre line of a tube.
//
// The curve is the centripetal Catmull-Rom spline (E. Catmull, R. Rom, "A class of local interpolating
// splines", 1974; knots by C. Yuksel, S. Schaefer, J. Keyser, "Parameterization and applications of
// Catmull-Rom curves", 2011): it passes through all points and has neither cusps nor loops between two of
// them. The frames turn about the curve as little as possible: W. Wang, B. Juettler, D. Zheng, Y. Liu,
// "Computation of rotation minimizing frames", 2008, the double reflection method. O(n).
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace tendril::app {

/// A point of the curve.
struct CurvePoint {
    glm::vec3 at{0.0f};
    glm::vec3 tangent{1.0f, 0.0f, 0.0f};  ///< unit
    glm::vec3 normal{0.0f, 1.0f, 0.0f};   ///< unit, perpendicular; the third axis is cross(tangent, normal)
    float along = 0.0f;                   ///< index of the given point, with a fraction between two
};

/// One piece of the curve, between two neighbouring points: a cubic with these derivatives at its ends.
struct CurveSpan {
    glm::vec3 a{0.0f}, b{0.0f};
    glm::vec3 slope_a{0.0f}, slope_b{0.0f};

    glm::vec3 at(float t) const;
    glm::vec3 slope(float t) const;
    /// Approximate turning angle in radians: from the first direction to the chord's, and on to the last.
    float turn() const;
};

/// The piece from points[i] to points[i + 1]. Consecutive points must not coincide, nor be farther than 1e9
/// from the origin.
CurveSpan curve_span(std::span<const glm::vec3> points, std::size_t i);

/// Sets the normals of points whose positions and tangents are set. The first normal depends only on the
/// first tangent, continuously except at one unlikely direction, so that a moving curve keeps its frames.
void set_frames(std::span<CurvePoint> points);

}  // namespace tendril::app
