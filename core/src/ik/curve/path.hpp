// The curve through control points, and where a chain's joints lie on it. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "ik/math.hpp"
#include "tendril/ik/curve.hpp"

namespace tendril::ik::detail {

/// A cubic piece by its Bezier points.
using Cubic = std::array<glm::dvec3, 4>;

/// A place on the path: `t` in 0 to 1 on a piece, metres beyond the end on the ray that continues the last.
struct Place {
    std::size_t piece = 0;
    double t = 0.0;
};

class Path {
  public:
    /// At least two points. `fallback`: unit, the direction of the ray if all points coincide.
    Path(std::span<const glm::vec3> points, CurveKind kind, const glm::dvec3& fallback) noexcept;

    std::size_t pieces() const noexcept { return points_.size() - 1; }
    bool collapsed() const noexcept { return collapsed_; }
    bool on_ray(const Place& place) const noexcept { return place.piece >= pieces(); }
    const glm::dvec3& end() const noexcept { return end_; }

    glm::dvec3 point(const Place& place) noexcept;
    /// Unit; `before` where the path has no direction.
    glm::dvec3 tangent(const Place& place, const glm::dvec3& before) noexcept;
    /// The first place after `from` that is `length` metres from `joint`, which is the point at `from`.
    Place next(const Place& from, const glm::dvec3& joint, double length) noexcept;

  private:
    glm::dvec3 control(std::ptrdiff_t index) const noexcept;
    const Cubic& piece(std::size_t index) noexcept;

    std::span<const glm::vec3> points_;
    CurveKind kind_;
    glm::dvec3 end_{0.0}, ray_{0.0};
    bool collapsed_ = false;
    std::size_t index_ = static_cast<std::size_t>(-1);  // of the piece kept in cubic_
    Cubic cubic_{};
};

}  // namespace tendril::ik::detail
