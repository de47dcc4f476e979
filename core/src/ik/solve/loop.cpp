#include "ik/solve/loop.hpp"

#include <algorithm>

#include "ik/limits/loop.hpp"
#include "ik/math.hpp"
#include "ik/methods/methods.hpp"
#include "ik/pole/pole.hpp"
#include "ik/solve/blend.hpp"
#include "ik/solve/convergence.hpp"
#include "ik/solve/perturbation.hpp"
#include "ik/solve/prepare.hpp"
#include "ik/solve/reachability.hpp"
#include "ik/solve/tip.hpp"
#include "ik/tunables.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::chain;

template <class Watch>
void iterate(Method method, Problem& problem, Watch watch) noexcept {
    switch (method) {
        case Method::Fabrik:
            return accelerated_fabrik_iteration(problem, watch);
        case Method::FabrikPlain:
            return fabrik_iteration(problem, watch);
        case Method::Ccd:
            return ccd_iteration(problem, watch);
        case Method::JacobianTranspose:
            return jacobian_transpose_iteration(problem, watch);
        case Method::Dls:
            return dls_iteration(problem, problem.options.damping, watch);
        case Method::SvdDls:
            return svd_dls_iteration(problem, problem.options.damping, watch);
        case Method::TwoBone:
            return;  // does not iterate
    }
}

void save(Problem& problem) noexcept {
    std::copy(problem.joints.begin(), problem.joints.end(), problem.scratch.best.begin());
}

template <class Watch>
void restore(Problem& problem, Watch watch) noexcept {
    for (std::size_t i = 1; i < problem.joints.size(); ++i) {
        watch.moved(problem.iteration, Phase::RestoreBest, i, no_joint, problem.joints[i],
                    problem.scratch.best[i]);
        problem.joints[i] = problem.scratch.best[i];
    }
    watch.next_step();
}

/// `goal` is the requested target; with a soft zone, problem.target differs from it.
template <class Watch>
void report_iteration(const Problem& problem, const glm::vec3& goal, float residual, Watch watch) noexcept {
    const std::span<float> residuals = problem.options.residuals;
    const auto iteration = static_cast<std::size_t>(problem.iteration);
    if (!Watch::watching && iteration > residuals.size()) return;
    if (goal != problem.target) residual = distance(problem.joints.back(), goal);
    if (iteration >= 1 && iteration <= residuals.size()) residuals[iteration - 1] = residual;
    watch.iteration_done(problem.iteration, residual);
}

template <class Watch>
void prepare_iterations(Method method, Problem& problem, Watch watch) noexcept {
    save(problem);
    snap_back(problem, problem.options.snap_back, watch);
    if (problem.residual() <= problem.tolerance) return;
    bool bent = bend_to_pole(problem, watch);
    if (!bent && method != Method::FabrikPlain && is_collinear(problem)) {
        bend_collinear_chain(problem, watch);
        bent = true;
    }
    problem.perturbations += bent;
}

template <class Watch>
Report iterations(Method method, Problem& problem, const glm::vec3& goal, Watch watch) noexcept {
    const Options& options = problem.options;
    const float reach = problem.scratch.reach;
    Convergence convergence({.window = tune::chain::stall_window, .moves = stall_moves * reach},
                            problem.residual(), reach);
    prepare_iterations(method, problem, watch);
    float residual = problem.residual();
    convergence.restart(residual);
    report_iteration(problem, goal, residual, watch);
    int slow = 0, perturbations = method == Method::FabrikPlain ? tune::chain::max_perturbations : 0;
    while (problem.iteration < options.max_iterations) {
        const bool converged = residual <= problem.tolerance;
        const bool stalled = convergence.stalled() || (method == Method::Fabrik && slow >= slow_window);
        if (!converged && stalled && perturbations < tune::chain::max_perturbations) {
            ++problem.perturbations;
            perturb(problem, perturbations++, watch);
            convergence.restart(problem.residual());
            slow = 0;
        }
        if ((converged || convergence.stalled()) && !options.every_iteration) break;
        ++problem.iteration;
        iterate(method, problem, watch);
        residual = problem.residual();
        report_iteration(problem, goal, residual, watch);
        slow = residual > slow_part * convergence.last() ? slow + 1 : 0;
        const bool continues = residual > problem.tolerance || options.every_iteration;
        if (convergence.record(residual) && continues) save(problem);
    }
    if (residual > problem.tolerance && convergence.best() < residual) {
        restore(problem, watch);
        residual = convergence.best();
    }
    const Status status = residual <= problem.tolerance ? Status::Converged
                          : convergence.stalled()       ? Status::Stalled
                                                        : Status::IterationLimit;
    return problem.report(status, residual);
}

template <class Watch>
Report closed_form(Problem& problem, const glm::vec3& goal, Watch watch) noexcept {
    report_iteration(problem, goal, problem.residual(), watch);
    problem.iteration = 1;
    const Report report = two_bone_solve(problem, watch);
    report_iteration(problem, goal, report.residual, watch);
    return report;
}

template <class Watch>
Report solve_reached(Method method, Problem& problem, const glm::vec3& goal, Watch watch) noexcept {
    if (!problem.options.limits.empty()) return run_limited(method, problem, watch);
    if (method == Method::TwoBone) return closed_form(problem, goal, watch);
    auto report = answer_beyond_reach(problem, watch);
    if (report) {
        report_iteration(problem, goal, report->residual, watch);
    } else {
        transport_to_pole(problem, watch);
        report = iterations(method, problem, goal, watch);
    }
    face_pole(problem, watch);  // the turn is about the line from root to tip, so the residual stays
    return *report;
}

/// The target with the soft zone applied. Two bones that may stretch reach further.
glm::vec3 eased_target(Method method, const Problem& problem) noexcept {
    const float zone = problem.options.soft_zone;
    if (zone == 0.0f) return problem.target;
    const bool stretches = method == Method::TwoBone && problem.options.limits.empty();
    Reachability can = reachability_of(problem);
    if (stretches) can.furthest *= static_cast<double>(problem.options.max_stretch_scale);
    const glm::dvec3 way = between(problem.root(), problem.target);
    const double far = length(way), eased = can.eased(far, static_cast<double>(zone));
    return eased < far ? moved(problem.root(), way, eased / far) : problem.target;
}

}  // namespace

template <class Watch>
Report run(Method method, Problem& problem, Watch watch) noexcept {
    const bool turned = problem.options.tip_orientation && problem.bones() > 0;
    const bool free = problem.options.limits.empty();
    if (turned && free) return run_with_tip_orientation(method, problem, watch);
    enforce_lengths(problem, watch);
    const glm::vec3 goal = problem.target;
    problem.target = eased_target(method, problem);
    Report report = solve_reached(method, problem, goal, watch);
    if (problem.target != goal) {
        report.residual = exact_distance(problem.joints.back(), goal);
        const bool converged = report.residual <= problem.tolerance;
        // The requested target decides, not the eased one that was reached.
        const bool eased = report.status == Status::Converged || report.status == Status::TooClose;
        if (converged) report.status = Status::Converged;
        if (!converged && eased) report.status = Status::Stretched;
        problem.target = goal;
    }
    if (free && (problem.options.rotations || problem.options.weight < 1.0f)) transport_rotations(problem);
    return report;
}

template <class Watch>
Report run_weighted(Method method, Problem& problem, Watch watch) noexcept {
    if (problem.options.weight == 1.0f) return run(method, problem, watch);
    save_given(problem, watch);
    const Report report = run(method, problem, watch);
    blend(problem, watch);
    return report;
}

template Report run(Method, Problem&, Unwatched) noexcept;
template Report run(Method, Problem&, Watched) noexcept;
template Report run_weighted(Method, Problem&, Unwatched) noexcept;
template Report run_weighted(Method, Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
