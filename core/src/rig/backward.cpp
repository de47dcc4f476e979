#include "tendril/rig/backward.hpp"

#include <algorithm>
#include <cmath>

#include "math/cholesky.hpp"
#include "rig/math.hpp"
#include "rig/parameters.hpp"

namespace tendril::rig {
namespace {

constexpr int parts = 9;  ///< numbers that are left of a bone: translation, rotation, scale

/// The rotation vector from one rotation to another, the short way round.
glm::dvec3 turn_between(const glm::dquat& from, const glm::dquat& to) noexcept {
    glm::dquat turn = math::compose(to, math::conjugate(from));
    if (turn.w < 0.0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = detail::length(axis);
    if (!(sine > 1e-12)) return detail::times(axis, 2.0);
    return detail::times(axis, 2.0 * detail::arctangent(sine, turn.w) / sine);
}

/// The mean distance of bones from their parents, for rotations and scales to count beside metres.
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

/// Springs that have come to rest are springs that have just begun.
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
    }

    /// From the control values of the state to the nearest minimum; they are left there. The sum of squares.
    double run(BackwardReport& report) {
        Parameters now(rig_.definition(), state_.controls);
        std::vector<double> left = left_of(now), trial_left;
        double cost = squared(left);
        double damping = 1e-3;
        for (report.iterations = 0;
             report.iterations < std::clamp(options_.max_iterations, 1, 10'000) && cost > 1e-24;
             ++report.iterations) {
            const double before = cost;
            linearize(now, left);
            // More damping makes a shorter step, nearer to steepest descent, until one gains.
            for (; damping < 1e12; damping *= 8.0) {
                const std::optional<Parameters> trial = stepped(now, damping);
                if (!trial) continue;
                trial_left = left_of(*trial);
                if (const double gained = squared(trial_left); gained < cost) {
                    now = *trial;
                    left.swap(trial_left);
                    cost = gained;
                    damping = std::max(1e-12, damping * 0.1);
                    break;
                }
            }
            if (!(cost < before * (1.0 - 1e-9))) break;
        }
        now.write(state_.controls);
        report.solves = solves_;
        return cost;
    }

  private:
    static double squared(const std::vector<double>& values) {
        double sum = 0.0;
        for (const double value : values) sum += value * value;
        return sum;
    }

    /// What is left of every bone with these control values, as one list.
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

    /// Fills the matrix J'J and the gradient J'r from differences.
    void linearize(const Parameters& now, const std::vector<double>& left) {
        const std::size_t count = now.size();
        columns_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double by = 1e-6 * std::max(1.0, std::abs(now.value(i))) * (now.at_maximum(i) ? -1.0 : 1.0);
            Parameters moved = now;
            moved.set(i, now.value(i) + by);
            columns_[i] = left_of(moved);
            for (std::size_t k = 0; k < left.size(); ++k) columns_[i][k] = (left[k] - columns_[i][k]) / by;
        }
        normal_.assign(count * count, 0.0);
        gradient_.assign(count, 0.0);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < left.size(); ++k) gradient_[i] += columns_[i][k] * left[k];
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = 0.0;
                for (std::size_t k = 0; k < left.size(); ++k) sum += columns_[i][k] * columns_[j][k];
                normal_[i * count + j] = normal_[j * count + i] = sum;
            }
        }
    }

    /// The damped step from there, within the limits; none where the matrix has no root.
    std::optional<Parameters> stepped(const Parameters& now, double damping) const {
        const std::size_t count = now.size();
        std::vector<double> matrix = normal_, step = gradient_;
        double largest = 0.0;
        for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, normal_[i * count + i]);
        if (!(largest > 0.0)) return std::nullopt;
        // The same for all: scaled to its own column, what hardly matters would be moved the furthest.
        for (std::size_t i = 0; i < count; ++i) matrix[i * count + i] += damping * largest;
        // A number at an end of its range that the descent pushes against stays there, and the others are
        // solved for without it.
        for (std::size_t i = 0; i < count; ++i) {
            if (!(now.at_maximum(i) && gradient_[i] > 0.0) && !(now.at_minimum(i) && gradient_[i] < 0.0))
                continue;
            for (std::size_t k = 0; k < count; ++k) matrix[i * count + k] = matrix[k * count + i] = 0.0;
            matrix[i * count + i] = 1.0;
            step[i] = 0.0;
        }
        if (!math::solve_cholesky(matrix, step)) return std::nullopt;
        Parameters trial = now;
        for (std::size_t i = 0; i < count; ++i) trial.set(i, now.value(i) + step[i]);
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
    std::vector<double> normal_, gradient_;
    int solves_ = 0;
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
    double cost = descent.run(report);
    for (std::size_t i = 0; i < start.size() && cost > 1e-16; ++i) {
        if (!rig.definition().elements[i].control || !std::holds_alternative<bool>(start[i])) continue;
        const std::vector<Value> best = state.controls;
        state.controls = start;
        for (std::size_t k = 0; k < i; ++k)
            if (std::holds_alternative<bool>(best[k])) state.controls[k] = best[k];
        state.controls[i] = !std::get<bool>(best[i]);
        if (const double other = descent.run(report); other < 0.99 * cost)
            cost = other;
        else
            state.controls = best;
    }
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
