// One linkage being solved: its constants, its pose, and the equations of the present step. Not installed.
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

constexpr double bound_width = 1e-9;  ///< a joint so near to the end of its range is at it; radians or sizes

/// Orthonormal rows by Gram-Schmidt: each is made orthogonal to those before it, twice if most of it cancels
/// (W. Kahan's rule: B. Parlett, "The Symmetric Eigenvalue Problem", 1980, 6.9). A row is nonzero only in its
/// window, so loops that share no joints cost each other nothing.
class RowBasis {
  public:
    void reserve(std::size_t columns);
    void clear() noexcept { count_ = 0; }
    std::size_t rank() const noexcept { return count_; }

    /// Makes `row` the unit vector in its new direction, and keeps that. Returns its length before, or 0, and
    /// keeps nothing, if the rows before span it: if what is left is rounding beside `scale`.
    double add(std::span<double> row, double scale) noexcept;
    /// Removes what the rows span.
    void remove_from(std::span<double> row) const noexcept;
    /// The sign of the determinant of the rows' columns that are not `held`, as many as there are rows.
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

/// By elimination, in place; 1 for none.
int sign_of_determinant(std::span<double> matrix, std::size_t size) noexcept;

struct LinkageWork {
    explicit LinkageWork(const Linkage& from = {});

    // Constants.
    Linkage linkage;
    std::vector<glm::dvec3> drawn_axes;  ///< unit
    std::vector<std::size_t> column;     ///< the first of each link
    std::size_t columns = 0;
    double size = 0.0;
    double rounding = 0.0;               ///< metres: what a closure cannot be closer to, far from the origin
    std::vector<std::uint8_t> straight;  ///< columns of sliders on no loop: a step of any length is as good
    bool planar = false;
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< of a planar one

    // The pose, and what follows from it.
    std::vector<JointPlace> joints;
    std::vector<LinkPlace> places;
    std::vector<glm::dvec3> origins, axes;  ///< of the joints, in the world
    /// Computes these for the joints.
    void move_links() noexcept;
    glm::dvec3 point_of(std::size_t link, const glm::dvec3& drawn) const noexcept {
        return link == ground_link ? drawn : places[link].point(drawn);
    }

    // Steps.
    std::vector<std::uint8_t> driven;   ///< columns that drivers hold
    std::vector<std::uint8_t> held;     ///< these, and columns at the end of their range
    std::vector<std::uint8_t> blocked;  ///< balls at their maximum: they turn no further outward
    std::vector<double> step;
    std::vector<double> moved;        ///< the sum of the steps of a return to the closures
    std::vector<JointPlace> kept;     ///< at the start of a step, to restore
    std::vector<JointPlace> best;     ///< before a perturbation
    std::vector<JointPlace> nearest;  ///< of several restarts
    /// Goes by `part` of the step, within the ranges.
    void take_step(double part) noexcept;
    /// Fills the step with pseudo-random numbers up to `range`; drivers' stay 0.
    void randomize_step(std::uint64_t& random, double range) noexcept;
    /// Only the drivers' columns are held.
    void release() noexcept;
    /// Brings the joints into their ranges, and balls to unit rotations.
    void clamp_to_ranges() noexcept;
    /// The axis about which a ball is turned, in the world; unit.
    glm::dvec3 outward_of(std::size_t link) const noexcept;
    /// A ball at its maximum, which the step would turn further.
    bool pushes_outward(std::size_t link) const noexcept;
    /// Units of a hinge's (radians) or slider's value (metres) per unit of its column.
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
    /// How many equations a closure has: those across the plane of a planar linkage are 0 = 0.
    std::size_t equations_of(const Closure& closure) const noexcept {
        return (planar ? 2u : 3u) + (closure.kind == ClosureKind::Point ? 0u : planar ? 1u : 3u);
    }
    Block target_block(const LinkTarget& target) noexcept;
    /// Metres; a frame's rotation counts by the size.
    double gap_of(const Closure& closure) const noexcept;
    double largest_gap() const noexcept;
    double squared_gap(const Closure& closure) const noexcept;
    glm::dvec3 position_of(const LinkTarget& target) const noexcept {
        const LinkPoint& point = linkage.points[target.point];
        return point_of(point.link, point.at);
    }
    glm::dvec3 target_gap(const LinkTarget& target) const noexcept;
    /// How far it is from its value, or from the end of its range before that; in columns' units.
    double driver_error(const LinkDriver& driver) const noexcept;

    RowBasis basis;
    std::vector<std::size_t> row_origin;   ///< of the basis' rows: six times the block, and which of its rows
    std::vector<double> square, gradient;  ///< normal equations, of all columns; lower triangle
    std::vector<double> pull;              ///< the gradient before what the closures span was removed
    std::vector<double> multiplier;        ///< of the basis' rows
    std::vector<double> curvature;         ///< second derivatives, symmetric
    std::vector<double> factor, solution;
    /// Add the second derivatives of a closure's gap or a point's position along a vector.
    void add_closure_curvature(std::size_t index, const glm::dvec3& along) noexcept;
    void add_point_curvature(std::size_t point, const glm::dvec3& along) noexcept;

    // The goals.
    std::vector<glm::dvec3> target_starts;    ///< of targets: where their points were
    std::vector<glm::dvec3> exact_positions;  ///< and where exact ones keep them
    std::vector<double> driver_starts;        ///< of each link

    // The sign of LinkageSolve::mode(), for the pose and the held columns that it is of.
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
