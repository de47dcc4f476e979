// One solve of a linkage. Not installed.
#pragma once

#include <algorithm>
#include <cmath>

#include "ik/linkage/work.hpp"

namespace tendril::ik::detail {

constexpr double max_turn_step = 0.5;  ///< radians of a joint: beyond it the tangent misleads
constexpr double reached = 1e-6;       ///< tolerance of a driver or target, radians or sizes

inline double norm_of(std::span<const double> step) noexcept {
    double sum = 0.0;
    for (const double each : step) sum += each * each;
    return std::sqrt(sum);
}

class LinkageSolve {
  public:
    LinkageSolve(LinkageWork& work, const LinkageGoals& goals, const LinkageOptions& options) noexcept;
    LinkageReport run() noexcept;

    /// Closes the linkage by descent from this pose, drivers fixed; false if it only brings closures nearer.
    bool close_from_here() noexcept;
    /// Sign of the closures' determinant with respect to the free joints: it changes only at a dead point of
    /// the held ones. 0 if these do not determine the pose.
    int mode() noexcept;
    void hold_drivers() noexcept;
    /// Number of independent closure equations in this pose.
    std::size_t closure_rank() noexcept;

  private:
    /// The residual that a descent minimises.
    enum class Aim { Closures, Drivers, ExactTargets, Targets };

    bool closed() const noexcept;
    /// Gap, metres, from which a closure counts as open, even near a dead point.
    double open_threshold() const noexcept {
        return std::max(tolerance_, 1e3 * std::max(1e-10 * work_.size, work_.rounding));
    }
    bool at_bound(std::size_t link, double by) const noexcept;
    /// Finds Newton's step on closures and reached exact targets, and the basis of their rows. Held columns
    /// keep their step.
    void find_correction() noexcept;
    /// `origin`: the closure's index, or the target's plus the number of closures.
    void add_rows(const LinkageWork::Block& block, std::size_t equations, std::size_t origin) noexcept;
    double add_row(std::span<double> row, double error, double scale, std::size_t origin) noexcept;
    void clear_step() noexcept;
    bool update_active_set() noexcept;
    /// Takes Newton's steps to the closures. False if they diverge or their norm exceeds `allowed`.
    bool project_to_closures(double allowed) noexcept;

    void assemble() noexcept;
    void drive() noexcept;
    void find_tangent(double from, double to) noexcept;
    bool drive_substep(double from, double to) noexcept;
    bool take_drive_step(double to) noexcept;
    bool repeat_last_move(double part) noexcept;
    bool jumped_branch() noexcept;
    int completed_mode(std::span<double> free, std::size_t& count) noexcept;
    double driver_distance(const LinkDriver& driver) const noexcept;

    void descend(Aim aim) noexcept;
    bool descend_from_here() noexcept;
    bool perturb() noexcept;
    bool descent_step(double damping) noexcept;
    bool at_minimum(double cost) const noexcept { return convex_ && predicted_gain_ <= 1e-12 * cost; }
    void add_equation(std::span<double> row, double error, double weight) noexcept;
    void find_equations() noexcept;
    void find_curvature() noexcept;
    void find_descent(double damping) noexcept;
    double move_along_gradient() const noexcept;
    bool aims_at_targets() const noexcept { return aim_ == Aim::ExactTargets || aim_ == Aim::Targets; }
    bool solve_equations(double damping, bool curved) noexcept;
    double cost() noexcept;
    double target_weight(const LinkTarget& target) const noexcept;
    void restore(const std::vector<JointPlace>& joints) noexcept;
    int watched_mode() noexcept;
    std::size_t free_columns() const noexcept;
    void store_active() noexcept;
    void find_jump(LinkageReport& report) noexcept;
    void finish(LinkageReport& report) noexcept;

    LinkageWork& work_;
    const LinkageGoals& goals_;
    const LinkageOptions& options_;
    double tolerance_;
    int iterations_ = 0;
    Aim aim_ = Aim::Closures;
    bool closes_ = true;  ///< closures are constraints, not goals
    /// Minimum part of a closure row that is independent of the previous rows; near 0 at a loss of rank.
    double rank_margin_ = 1.0;
    double min_rank_margin_ = 1.0;     ///< minimum of these in a substep of a drive
    double length_of_step_ = 0.0;      ///< predicted length of that substep
    bool keeps_exact_ = false;         ///< exact targets are constraints too
    double max_weight_ = 0.0;          ///< maximum weight of the aim's targets
    bool descended_ = false;           ///< the last descent took a step
    double predicted_gain_ = 0.0;      ///< for the last step of a descent
    bool convex_ = true;               ///< the last step was Newton's: the curvature was positive
    bool gauss_newton_ = false;        ///< use a Gauss-Newton step next
    bool negative_curvature_ = false;  ///< the cost curves downwards along the last step
    /// Metres by which a step along the first gradient moves the targets' points. Negative until known.
    double initial_move_ = -1.0;
    bool was_nonconvex_ = false;  ///< a step with negative_curvature_ was taken
    bool stopped_ = false, out_of_iterations_ = false, beyond_range_ = false;
};

/// Finds a closed pose in another assembly mode, with the drivers' joints held; or NotFound.
Result find_other_mode(LinkageWork& work, LinkageState& state, std::span<const LinkDriver> drivers,
                       OtherMode which) noexcept;

}  // namespace tendril::ik::detail
