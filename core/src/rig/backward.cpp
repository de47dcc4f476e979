#include "tendril/rig/backward.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "rig/math.hpp"
#include "rig/normal_equations.hpp"
#include "rig/parameters.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::rig {
namespace {

constexpr int iteration_limit = 10'000;
constexpr int parts = 9;  ///< residuals per bone: three each of translation, rotation, scale
// Work, in steps of about 30 ns, as in Rig::work.
constexpr std::uint64_t work_per_solved_bone = 4, multiplications_per_step = 48;

/// The rotation vector from one rotation to another, the short way round.
glm::dvec3 turn_between(const glm::dquat& from, const glm::dquat& to) noexcept {
    glm::dquat turn = math::compose(to, math::conjugate(from));
    if (turn.w < 0.0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = detail::length(axis);
    if (!(sine > 1e-12)) return detail::times(axis, 2.0);
    return detail::times(axis, 2.0 * detail::arctangent(sine, turn.w) / sine);
}

/// The mean distance of bones from their parents: the scale that weighs rotations and scales against metres.
double mean_length(const Rig& rig, State& state) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < rig.definition().elements.size(); ++i) {
        if (rig.definition().elements[i].kind != ElementKind::Bone ||
            rig.definition().elements[i].parent.empty())
            continue;
        sum += detail::length(state.elements.get(rig.id(i), Space::Local, Pose::Initial).translation);
        ++count;
    }
    return count > 0 && sum > 1e-9 ? sum / count : 1.0;
}

/// Clears the memory of all units. A spring without memory starts at rest at its target.
void clear_memory(State& state) {
    for (UnitState& unit : state.units)
        for (UnitMemory& memory : unit.memory) memory.held = std::monostate();
}

class Descent {
  public:
    Descent(const Rig& rig, State& state, Workspace& workspace, const BackwardOptions& options)
        : rig_(rig), state_(state), workspace_(workspace), options_(options) {
        radius_ = options.metres_per_radian > 0.0 ? options.metres_per_radian : mean_length(rig, state);
        for (std::size_t i = 0; i < rig.definition().elements.size(); ++i) {
            if (rig.definition().elements[i].kind != ElementKind::Bone) continue;
            bones_.push_back(rig.id(i));
            targets_.push_back(state.elements.get(rig.id(i), Space::Global));
        }
        solve_work_ = rig.work() + work_per_solved_bone * bones_.size();
    }

    /// Descends from the state's control values to the nearest minimum, or until the work is used up. Writes
    /// the final values to the state and returns the sum of squares.
    double run() {
        Parameters now(rig_.definition(), state_.controls);
        std::vector<double> residuals = residuals_at(now);
        double cost = squared(residuals);
        damping_ = 1e-3;
        const int max_iterations = std::clamp(options_.max_iterations, 1, iteration_limit);
        for (iterations_ = 0; cost > 1e-24; ++iterations_) {
            if (iterations_ == max_iterations) {
                stopped_ = true;
                break;
            }
            const double before = cost;
            if (!linearize(now, residuals)) break;
            descend(now, residuals, cost);
            if (!(cost < before * (1.0 - 1e-9))) break;
        }
        now.write(state_.controls);
        return cost;
    }

    bool work_exhausted() const { return work_exhausted_; }
    void report_to(BackwardReport& report) const {
        report.iterations = iterations_;
        report.solves = solves_;
        report.stopped = stopped_ || work_exhausted_;
    }

  private:
    static double squared(const std::vector<double>& values) {
        double sum = 0.0;
        for (const double value : values) sum += value * value;
        return sum;
    }

    /// Counts `more` work; false if that would exceed the limit.
    bool spend(std::uint64_t more) {
        if (options_.max_work > 0 && work_ + more > options_.max_work) work_exhausted_ = true;
        if (!work_exhausted_) work_ += more;
        return !work_exhausted_;
    }

    /// Increases the damping until a step reduces the cost. Damping shortens the step and turns it towards
    /// steepest descent.
    void descend(Parameters& now, std::vector<double>& residuals, double& cost) {
        for (; damping_ < 1e12; damping_ *= 8.0) {
            if (!spend(equations_.solve_cost() / multiplications_per_step + solve_work_)) return;
            const std::optional<Parameters> trial = stepped(now);
            if (!trial) continue;
            std::vector<double> trial_residuals = residuals_at(*trial);
            const double trial_cost = squared(trial_residuals);
            if (!(trial_cost < cost)) continue;
            now = *trial;
            residuals.swap(trial_residuals);
            cost = trial_cost;
            damping_ = std::max(1e-12, damping_ * 0.1);
            return;
        }
    }

    /// The residuals of all bones for these control values.
    std::vector<double> residuals_at(const Parameters& parameters) {
        parameters.write(state_.controls);
        clear_memory(state_);
        rig_.solve(state_, 0.0, workspace_);
        ++solves_;
        std::vector<double> residuals;
        residuals.reserve(bones_.size() * parts);
        for (std::size_t i = 0; i < bones_.size(); ++i) {
            const Transform& pose = state_.elements.get(bones_[i], Space::Global);
            const glm::dvec3 move = detail::minus(targets_[i].translation, pose.translation);
            const glm::dvec3 turn = detail::times(turn_between(pose.rotation, targets_[i].rotation), radius_);
            const glm::dvec3 scale = detail::times(detail::minus(targets_[i].scale, pose.scale), radius_);
            for (const glm::dvec3* part : {&move, &turn, &scale})
                residuals.insert(residuals.end(), {part->x, part->y, part->z});
        }
        return residuals;
    }

    /// Derivatives by finite differences. False if that would exceed the work limit.
    bool linearize(const Parameters& now, const std::vector<double>& base) {
        if (!spend(now.size() * solve_work_)) return false;
        columns_.resize(now.size());
        Parameters moved = now;
        for (std::size_t i = 0; i < now.size(); ++i) {
            const double by = 1e-6 * std::max(1.0, std::abs(now.value(i))) * (now.at_maximum(i) ? -1.0 : 1.0);
            moved.set(i, now.value(i) + by);
            columns_[i] = residuals_at(moved);
            moved.set(i, now.value(i));
            for (std::size_t k = 0; k < base.size(); ++k) columns_[i][k] = (base[k] - columns_[i][k]) / by;
        }
        equations_.plan(columns_);
        if (!spend(equations_.assembly_cost() / multiplications_per_step)) return false;
        equations_.assemble(columns_, base);
        return true;
    }

    /// The damped step from `now`, within the limits. A parameter at a bound that the descent pushes against
    /// stays fixed.
    std::optional<Parameters> stepped(const Parameters& now) {
        const std::vector<double>& gradient = equations_.gradient();
        fixed_.resize(now.size());
        for (std::size_t i = 0; i < now.size(); ++i)
            fixed_[i] = (now.at_maximum(i) && gradient[i] > 0.0) || (now.at_minimum(i) && gradient[i] < 0.0);
        if (!equations_.solve(damping_, fixed_, step_)) return std::nullopt;
        Parameters trial = now;
        for (std::size_t i = 0; i < now.size(); ++i) trial.set(i, now.value(i) + step_[i]);
        trial.clamp();
        return trial;
    }

    const Rig& rig_;
    State& state_;
    Workspace& workspace_;
    const BackwardOptions& options_;
    double radius_ = 1.0;
    std::vector<ElementId> bones_;
    std::vector<Transform> targets_;
    std::vector<std::vector<double>> columns_;
    NormalEquations equations_;
    std::vector<bool> fixed_;
    std::vector<double> step_;
    double damping_ = 1e-3;
    std::uint64_t solve_work_, work_ = 0;  ///< in steps of about 30 ns
    int iterations_ = 0, solves_ = 0;
    bool stopped_ = false, work_exhausted_ = false;
};

}  // namespace

std::vector<Residual> residuals(const Rig& rig, State& state, State& wanted) {
    std::vector<Residual> all(rig.definition().elements.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (rig.definition().elements[i].kind != ElementKind::Bone) continue;
        const Transform& current = state.elements.get(rig.id(i), Space::Global);
        const Transform& target = wanted.elements.get(rig.id(i), Space::Global);
        all[i].metres = detail::length(detail::minus(target.translation, current.translation));
        all[i].radians = detail::length(turn_between(current.rotation, target.rotation));
        const glm::dvec3 scale = detail::minus(target.scale, current.scale);
        all[i].scale = std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
    }
    return all;
}

BackwardReport solve_backward(const Rig& rig, State& state, Workspace& workspace,
                              const BackwardOptions& options) {
    BackwardReport report;
    State wanted = state;
    Descent descent(rig, state, workspace, options);
    const std::vector<Value> start = state.controls;
    double cost = descent.run();
    for (std::size_t i = 0; i < start.size() && cost > 1e-16 && !descent.work_exhausted(); ++i) {
        if (!rig.definition().elements[i].control || !std::holds_alternative<bool>(start[i])) continue;
        const std::vector<Value> best = state.controls;
        state.controls = start;
        for (std::size_t k = 0; k < i; ++k)
            if (std::holds_alternative<bool>(best[k])) state.controls[k] = best[k];
        state.controls[i] = !std::get<bool>(best[i]);
        if (const double other = descent.run(); other < 0.99 * cost)
            cost = other;
        else
            state.controls = best;
    }
    descent.report_to(report);
    clear_memory(state);
    rig.solve(state, 0.0, workspace);

    report.elements = residuals(rig, state, wanted);
    const double radius =
        options.metres_per_radian > 0.0 ? options.metres_per_radian : mean_length(rig, state);
    double worst = -1.0;
    for (std::size_t i = 0; i < report.elements.size(); ++i) {
        if (rig.definition().elements[i].kind != ElementKind::Bone) continue;
        const Residual& residual = report.elements[i];
        if (const double all = residual.metres + radius * (residual.radians + residual.scale); all > worst) {
            worst = all;
            report.worst = i;
        }
    }
    return report;
}

}  // namespace tendril::rig

template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::BackwardOptions>() noexcept {
    using rig::BackwardOptions;
    static constexpr Field rows[] = {
        field<&BackwardOptions::max_iterations>("max_iterations", {1.0, rig::iteration_limit}),
        field<&BackwardOptions::metres_per_radian>("metres_per_radian", {0.0, max_magnitude}, "m/rad"),
        field<&BackwardOptions::max_work>("max_work", {0.0, 1e15})};
    return rows;
}
