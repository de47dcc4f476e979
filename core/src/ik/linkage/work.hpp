// One linkage being solved: its constants, its pose, and the equations of the current step. Not installed.
//
// Columns are the joints' freedoms: one of a hinge (radians) or slider (in sizes of the linkage, so that the
// norm of a step does not depend on units), three of a ball (a rotation vector in the world).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ik/math.hpp"
#include "tendril/ik/linkage.hpp"

namespace tendril::ik::detail {

constexpr double bound_width = 1e-9;  ///< a joint this near to an end of its range is at it; radians or sizes

/// Orthonormal rows by Gram-Schmidt: each is made orthogonal to those before it, twice if most of it cancels
/// (W. Kahan's rule: B. Parlett, "The Symmetric Eigenvalue Problem", 1980, 6.9). A row is nonzero only in its
/// window, so loops that share no joints cost each other nothing.
class RowBasis {
  public:
    void reserve(std::size_t columns);
    void clear() noexcept { count_ = 0; }
    std::size_t rank() const noexcept { return count_; }

    /// Makes `row` orthogonal to the earlier rows, normalises and stores it. Returns its length before
    /// normalising, or 0, storing nothing, if only rounding relative to `scale` is left.
    double add(std::span<double> row, double scale) noexcept;
    /// Removes the part that the rows span.
    void remove_from(std::span<double> row) const noexcept;
    /// The sign of the determinant of the columns that are not `held`, as many as there are rows.
    /// `scratch`: columns * columns.
    int orientation(std::span<const std::uint8_t> held, std::span<double> scratch) const noexcept;
    /// Multipliers of the rows as given, as many as the rank, whose weighted sum is the part of `sum` that
    /// the rows span.
    void multipliers(std::span<const double> sum, std::span<double> found) const noexcept;

  private:
    struct Window {
        std::size_t first, last;
    };
    void subtract_from(double* row, Window& window, double* parts = nullptr) const noexcept;

    std::size_t columns_ = 0, count_ = 0;
    std::vector<double> rows_;
    std::vector<double> triangle_;  ///< the rows as given, in terms of the orthonormal ones
    std::vector<Window> windows_;
};

/// By elimination, in place; 1 if empty.
int sign_of_determinant(std::span<double> matrix, std::size_t size) noexcept;

struct LinkageWork {
    explicit LinkageWork(const Linkage& from = {});

    // Constants.
    Linkage linkage;
    std::vector<glm::dvec3> drawn_axes;  ///< unit
    std::vector<std::size_t> column;     ///< each link's first column
    std::size_t columns = 0;
    double size = 0.0;
    double rounding = 0.0;               ///< metres: far from the origin, a closure cannot get any closer
    std::vector<std::uint8_t> straight;  ///< columns of sliders on no loop: steps of any length are exact
    bool planar = false;
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< normal of a planar linkage

    // The pose, and data that depends on it.
    std::vector<JointPlace> joints;
    std::vector<LinkPlace> places;
    std::vector<glm::dvec3> origins, axes;  ///< the joints', in the world, as computed by move_links()
    void move_links() noexcept;
    glm::dvec3 point_of(std::size_t link, const glm::dvec3& drawn) const noexcept {
        return link == ground_link ? drawn : places[link].point(drawn);
    }

    // Steps.
    std::vector<std::uint8_t> driven;   ///< columns that drivers hold
    std::vector<std::uint8_t> held;     ///< driven ones, and columns at an end of their range
    std::vector<std::uint8_t> blocked;  ///< balls at their maximum, which turn no further outward
    std::vector<double> step;
    std::vector<double> moved;            ///< sum of the steps since the return to the closures began
    std::vector<JointPlace> before_step;  ///< before a step
    std::vector<JointPlace> saved;        ///< before a perturbation
    std::vector<JointPlace> nearest;      ///< the most nearly closed pose of several restarts
    /// Moves the joints by `part` of the step, within their ranges.
    void take_step(double part) noexcept;
    /// Fills the step with pseudo-random numbers up to `range`; drivers' stay 0.
    void randomize_step(std::uint64_t& random, double range) noexcept;
    /// Holds only the drivers' columns.
    void release() noexcept;
    /// Brings the joints into their ranges, and normalises the rotations of balls.
    void clamp_to_ranges() noexcept;
    /// The axis, in the world, about which a ball is turned; unit.
    glm::dvec3 outward_of(std::size_t link) const noexcept;
    /// True if a ball is at its maximum and the step would turn it further.
    bool pushes_outward(std::size_t link) const noexcept;
    /// Radians (hinge) or metres (slider) per unit of the link's column.
    double unit_of(std::size_t link) const noexcept {
        return linkage.links[link].joint == LinkJoint::Slider ? size : 1.0;
    }
    bool ranged(std::size_t link) const noexcept;
    /// Largest rotation in the step, radians; straight columns are ignored.
    double max_turn() const noexcept;

    // Equations. A block holds the derivatives of its errors with respect to the columns.
    struct Block {
        std::size_t count = 0;
        std::array<double, 6> errors{};  ///< closure residual
    };
    std::span<double> row(std::size_t index) noexcept {
        return {block_rows.data() + index * columns, columns};
    }
    std::vector<double> block_rows;  ///< six rows
    Block closure_block(std::size_t index) noexcept;
    /// Number of equations of a closure. Those across the plane of a planar linkage are 0 = 0 and omitted.
    std::size_t equations_of(const Closure& closure) const noexcept {
        return (planar ? 2u : 3u) + (closure.kind == ClosureKind::Point ? 0u : planar ? 1u : 3u);
    }
    Block target_block(const LinkTarget& target) noexcept;
    /// A closure's gap, metres; a frame's rotation is scaled by the linkage's size.
    double gap_of(const Closure& closure) const noexcept;
    double largest_gap() const noexcept;
    double squared_gap(const Closure& closure) const noexcept;
    glm::dvec3 position_of(const LinkTarget& target) const noexcept {
        const LinkPoint& point = linkage.points[target.point];
        return point_of(point.link, point.at);
    }
    glm::dvec3 target_gap(const LinkTarget& target) const noexcept;
    /// Distance of a driver from its value, or from the end of its range before it, in column units.
    double driver_error(const LinkDriver& driver) const noexcept;

    RowBasis basis;
    std::vector<std::size_t> row_origin;   ///< by row of the basis: six times its block, plus its row there
    std::vector<double> square, gradient;  ///< normal equations, of all columns; lower triangle
    std::vector<double> force;             ///< the gradient before removing the part that closures span
    std::vector<double> multiplier;        ///< by row of the basis
    std::vector<double> curvature;         ///< second derivatives, symmetric
    std::vector<double> factor, solution;
    /// Adds the second derivatives of a closure's gap or a point's position along a vector.
    void add_closure_curvature(std::size_t index, const glm::dvec3& along) noexcept;
    void add_point_curvature(std::size_t point, const glm::dvec3& along) noexcept;

    // The goals.
    std::vector<glm::dvec3> target_starts;    ///< start positions of the targets' points
    std::vector<glm::dvec3> exact_positions;  ///< positions at which exact targets keep their points
    std::vector<double> driver_starts;        ///< by link

    // The sign of LinkageSolve::mode(), valid for this pose and these held columns.
    int mode = 0;
    std::vector<JointPlace> mode_at;
    std::vector<std::uint8_t> mode_held;

    // For the report.
    std::vector<double> residuals;
    std::vector<std::size_t> active, open;

  private:
    void add_point(std::size_t link, const glm::dvec3& at, double sign) noexcept;
    void add_turn(std::size_t link, double sign) noexcept;
    void add_curvature(std::size_t link, const glm::dvec3& at, const glm::dvec3& along) noexcept;
    double travel_size() const noexcept;
    glm::dvec3 turn_between(const Closure& closure) const noexcept;
};

}  // namespace tendril::ik::detail
