// A smooth curve through points, with a frame at each of its points that does not twist: what a tube is swept
// along.
//
// The curve is the centripetal Catmull-Rom spline (E. Catmull, R. Rom, "A class of local interpolating
// splines", 1974; knots by C. Yuksel, S. Schaefer, J. Keyser, "Parameterization and applications of
// Catmull-Rom curves", 2011): it goes through all points and has neither cusps nor loops between two of them.
// The frames turn about the curve as little as they can: W. Wang, B. Juettler, D. Zheng, Y. Liu, "Computation
// of rotation minimizing frames", 2008, the double reflection method. O(n).
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace tendril::app {

/// A point of the curve.
struct CurvePoint {
    glm::vec3 at{0.0f};
    glm::vec3 tangent{1.0f, 0.0f, 0.0f};  ///< unit
    glm::vec3 normal{0.0f, 1.0f, 0.0f};   ///< unit, across the tangent; the third axis is their cross product
    float along = 0.0f;                   ///< which of the given points it is at, or between which
};

/// One piece of the curve, between two neighbouring points, as a cubic with these derivatives at its ends.
struct CurveSpan {
    glm::vec3 a{0.0f}, b{0.0f};
    glm::vec3 slope_a{0.0f}, slope_b{0.0f};

    glm::vec3 at(float t) const;
    glm::vec3 slope(float t) const;
    /// Radians that it turns by, roughly: from its first direction to that of its chord, and on to its last.
    float turn() const;
};

/// The piece from points[i] to points[i + 1]. Points that follow one another must not coincide, nor lie
/// farther from the origin than 1e9.
CurveSpan curve_span(std::span<const glm::vec3> points, std::size_t i);

/// Sets the normals of points whose positions and tangents are set. The first depends on the first tangent
/// alone, and steadily but where that points in one odd direction, so a curve that moves keeps its frames.
void set_frames(std::span<CurvePoint> points);

}  // namespace tendril::app
