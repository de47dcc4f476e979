// The curve through control points, and the positions of a chain's joints on it. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "ik/math.hpp"
#include "tendril/ik/curve.hpp"

namespace tendril::ik::detail {

/// A cubic piece by its Bezier points.
using Cubic = std::array<glm::dvec3, 4>;

/// A cubic in powers of t: a + b t + c t^2 + d t^3.
struct Powers {
    glm::dvec3 a{0.0}, b{0.0}, c{0.0}, d{0.0};

    Powers() = default;
    explicit Powers(const Cubic& p) noexcept
        : a(p[0]),
          b(times(minus(p[1], p[0]), 3.0)),
          c(times(plus(minus(p[0], times(p[1], 2.0)), p[2]), 3.0)),
          d(plus(minus(p[3], p[0]), times(minus(p[1], p[2]), 3.0))) {}
    glm::dvec3 at(double t) const noexcept {
        return plus(a, times(plus(b, times(plus(c, times(d, t)), t)), t));
    }
    glm::dvec3 slope(double t) const noexcept {
        return plus(b, times(plus(times(c, 2.0), times(d, 3.0 * t)), t));
    }
};

/// A position on the path: `t` from 0 to 1 on a piece, or metres along the ray beyond the end.
struct PathParam {
    std::size_t piece = 0;
    double t = 0.0;
};

struct PathPoint {
    glm::dvec3 at, tangent;
};

class Path {
  public:
    /// `points`: two or more. `fallback`: unit, the direction of the ray if all points coincide.
    Path(std::span<const glm::vec3> points, CurveKind kind, const glm::dvec3& fallback) noexcept;

    std::size_t pieces() const noexcept { return points_.size() - 1; }
    bool collapsed() const noexcept { return collapsed_; }
    bool on_ray(const PathParam& param) const noexcept { return param.piece >= pieces(); }
    const glm::dvec3& end() const noexcept { return end_; }

    glm::dvec3 point(const PathParam& param) noexcept;
    /// `tangent`: unit; `before` if the path has no direction there.
    PathPoint sample(const PathParam& param, const glm::dvec3& before) noexcept;
    /// The first position after `from` that is `length` metres from `joint`, which is the point at `from`.
    PathParam next(const PathParam& from, const glm::dvec3& joint, double length) noexcept;
    /// True if the distance from `centre` always increases between two positions, one of them `length` metres
    /// away. Ignores dips of the squared distance by less than 1e-9 of length^2.
    bool distance_grows(const PathParam& from, const PathParam& to, const glm::dvec3& centre,
                        double length) noexcept;

  private:
    glm::dvec3 control(std::ptrdiff_t index) const noexcept;
    struct Piece {
        Cubic cubic{};
        Powers powers{};
        std::size_t index = static_cast<std::size_t>(-1);
        double speed = 0.0, bend = 0.0;  ///< bounds of the cubic's first and second derivative
    };
    const Piece& piece(std::size_t index) noexcept;

    std::span<const glm::vec3> points_;
    CurveKind kind_;
    glm::dvec3 end_{0.0}, ray_{0.0};
    bool collapsed_ = false;
    std::array<Piece, 2> pieces_{};  // the last even one and the last odd one
};

}  // namespace tendril::ik::detail
