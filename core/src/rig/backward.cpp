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

constexpr int most_iterations = 10'000;
constexpr int parts = 9;  ///< residuals per bone: three each of translation, rotation, scale
// Work, in steps of about 30 ns, as in Rig::work.
constexpr std::uint64_t work_a_solved_bone = 4, multiplications_a_step = 48;

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
void forget(State& state) {
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
            wanted_.push_back(state.elements.get(rig.id(i), Space::Global));
        }
        solve_work_ = rig.work() + work_a_solved_bone * bones_.size();
    }

    /// Descends from the state's control values to the nearest minimum, or until the work is used up. Writes
    /// the final values to the state and returns the sum of squares.
    double run() {
        Parameters now(rig_.definition(), state_.controls);
        std::vector<double> left = left_of(now);
        double cost = squared(left);
        damping_ = 1e-3;
        const int most = std::clamp(options_.max_iterations, 1, most_iterations);
        for (iterations_ = 0; cost > 1e-24; ++iterations_) {
            if (iterations_ == most) {
                stopped_ = true;
                break;
            }
            const double before = cost;
            if (!linearize(now, left)) break;
            descend(now, left, cost);
            if (!(cost < before * (1.0 - 1e-9))) break;
        }
        now.write(state_.controls);
        return cost;
    }

    bool out_of_work() const { return out_of_work_; }
    void report_to(BackwardReport& report) const {
        report.iterations = iterations_;
        report.solves = solves_;
        report.stopped = stopped_ || out_of_work_;
    }

  private:
    static double squared(const std::vector<double>& values) {
        double sum = 0.0;
        for (const double value : values) sum += value * value;
        return sum;
    }

    /// Counts `more` work; false if that would exceed the limit.
    bool spend(std::uint64_t more) {
        if (options_.max_work > 0 && work_ + more > options_.max_work) out_of_work_ = true;
        if (!out_of_work_) work_ += more;
        return !out_of_work_;
    }

    /// Increases the damping until a step reduces the cost. Damping shortens the step and turns it towards
    /// steepest descent.
    void descend(Parameters& now, std::vector<double>& left, double& cost) {
        for (; damping_ < 1e12; damping_ *= 8.0) {
            if (!spend(equations_.solving() / multiplications_a_step + solve_work_)) return;
            const std::optional<Parameters> trial = stepped(now);
            if (!trial) continue;
            std::vector<double> trial_left = left_of(*trial);
            const double gained = squared(trial_left);
            if (!(gained < cost)) continue;
            now = *trial;
            left.swap(trial_left);
            cost = gained;
            damping_ = std::max(1e-12, damping_ * 0.1);
            return;
        }
    }

    /// The residuals of all bones for these control values.
    std::vector<double> left_of(const Parameters& parameters) {
        parameters.write(state_.controls);
        forget(state_);
        rig_.solve(state_, 0.0, workspace_);
        ++solves_;
        std::vector<double> left;
        left.reserve(bones_.size() * parts);
        for (std::size_t i = 0; i < bones_.size(); ++i) {
            const Transform& is = state_.elements.get(bones_[i], Space::Global);
            const glm::dvec3 move = detail::minus(wanted_[i].translation, is.translation);
            const glm::dvec3 turn = detail::times(turn_between(is.rotation, wanted_[i].rotation), radius_);
            const glm::dvec3 grow = detail::times(detail::minus(wanted_[i].scale, is.scale), radius_);
            for (const glm::dvec3* part : {&move, &turn, &grow})
                left.insert(left.end(), {part->x, part->y, part->z});
        }
        return left;
    }

    /// Derivatives by finite differences. False if that would exceed the work limit.
    bool linearize(const Parameters& now, const std::vector<double>& left) {
        if (!spend(now.size() * solve_work_)) return false;
        columns_.resize(now.size());
        Parameters moved = now;
        for (std::size_t i = 0; i < now.size(); ++i) {
            const double by = 1e-6 * std::max(1.0, std::abs(now.value(i))) * (now.at_maximum(i) ? -1.0 : 1.0);
            moved.set(i, now.value(i) + by);
            columns_[i] = left_of(moved);
            moved.set(i, now.value(i));
            for (std::size_t k = 0; k < left.size(); ++k) columns_[i][k] = (left[k] - columns_[i][k]) / by;
        }
        equations_.plan(columns_);
        if (!spend(equations_.assembling() / multiplications_a_step)) return false;
        equations_.assemble(columns_, left);
        return true;
    }

    /// The damped step from `now`, within the limits. A parameter at a bound that the descent pushes against
    /// stays fixed.
    std::optional<Parameters> stepped(const Parameters& now) {
        const std::vector<double>& gradient = equations_.gradient();
        still_.resize(now.size());
        for (std::size_t i = 0; i < now.size(); ++i)
            still_[i] = (now.at_maximum(i) && gradient[i] > 0.0) || (now.at_minimum(i) && gradient[i] < 0.0);
        if (!equations_.solve(damping_, still_, step_)) return std::nullopt;
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
    std::vector<Transform> wanted_;
    std::vector<std::vector<double>> columns_;
    NormalEquations equations_;
    std::vector<bool> still_;
    std::vector<double> step_;
    double damping_ = 1e-3;
    std::uint64_t solve_work_, work_ = 0;  ///< in steps of about 30 ns
    int iterations_ = 0, solves_ = 0;
    bool stopped_ = false, out_of_work_ = false;
};

}  // namespace

std::vector<Residual> residuals(const Rig& rig, State& state, State& wanted) {
    std::vector<Residual> all(rig.definition().elements.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (rig.definition().elements[i].kind != ElementKind::Bone) continue;
        const Transform& is = state.elements.get(rig.id(i), Space::Global);
        const Transform& should = wanted.elements.get(rig.id(i), Space::Global);
        all[i].metres = detail::length(detail::minus(should.translation, is.translation));
        all[i].radians = detail::length(turn_between(is.rotation, should.rotation));
        const glm::dvec3 grow = detail::minus(should.scale, is.scale);
        all[i].scale = std::max({std::abs(grow.x), std::abs(grow.y), std::abs(grow.z)});
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
    for (std::size_t i = 0; i < start.size() && cost > 1e-16 && !descent.out_of_work(); ++i) {
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
    forget(state);
    rig.solve(state, 0.0, workspace);

    report.elements = residuals(rig, state, wanted);
    const double radius =
        options.metres_per_radian > 0.0 ? options.metres_per_radian : mean_length(rig, state);
    double most = -1.0;
    for (std::size_t i = 0; i < report.elements.size(); ++i) {
        if (rig.definition().elements[i].kind != ElementKind::Bone) continue;
        const Residual& left = report.elements[i];
        if (const double all = left.metres + radius * (left.radians + left.scale); all > most) {
            most = all;
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
        field<&BackwardOptions::max_iterations>("max_iterations", {1.0, rig::most_iterations}),
        field<&BackwardOptions::metres_per_radian>("metres_per_radian", {0.0, max_magnitude}, "m/rad"),
        field<&BackwardOptions::max_work>("max_work", {0.0, 1e15})};
    return rows;
}
