// The main loop of solves with limits.
#include "ik/limits/loop.hpp"

#include <algorithm>
#include <limits>

#include "ik/limits/descent.hpp"
#include "ik/limits/methods.hpp"
#include "ik/limits/pole.hpp"
#include "ik/limits/pose.hpp"
#include "ik/limits/starts.hpp"
#include "ik/limits/stopped.hpp"
#include "ik/pole/pole.hpp"
#include "ik/solve/convergence.hpp"
#include "ik/solve/prepare.hpp"
#include "ik/solve/reachability.hpp"
#include "ik/tunables.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::limits;

/// Status and minimum residual of the target if the chain had no limits.
struct Reachable {
    Status status = Status::Converged;
    float residual = 0.0f;
};

Reachable reachable(const Problem& problem) noexcept {
    const Reachability can = reachability_of(problem);
    const double far = length(between(problem.root(), problem.target));
    return {can.status(far, 1e-6 * can.furthest), static_cast<float>(can.residual(far))};
}

float limited_residual(const Problem& problem) noexcept {
    return distance(problem.scratch.limited.pose.joints[problem.bones()], problem.target);
}

bool is_turned(const Problem& problem) noexcept {
    const std::optional<glm::vec3> rotation = orientation_error(problem, problem.scratch.limited.pose);
    return !rotation || length(*rotation) <= orientation_tolerance * orientation_arm * problem.scratch.reach;
}

/// True if the tip is at the target, or as near as any pose can bring it.
bool arrived(const Problem& problem, const Reachable& can) noexcept {
    const float residual = limited_residual(problem);
    const float more = can.status == Status::Converged ? 0.0f : straight_tolerance * problem.scratch.reach;
    return residual <= std::max(problem.tolerance, can.residual + more) && is_turned(problem);
}

/// Straightens the chain towards the target, or folds it back along its longest bone, if the limits allow it.
/// Returns whether they do.
template <class Watch>
bool straighten_within_limits(Problem& problem, const Reachable& can, float allowance, Watch watch) noexcept {
    if (can.status == Status::Converged || problem.options.tip_orientation) return false;
    LimitedScratch& scratch = problem.scratch.limited;
    LimitedPose& pose = scratch.trial;
    pose.joints[0] = problem.root();
    const glm::vec3 ahead = math::direction(problem.root(), problem.target, scratch.pose.directions[0]);
    const float allowed = straight_tolerance * problem.scratch.reach;
    float lost = 0.0f;     // distance lost to joints that cannot be straight
    bool pointed = false;  // a longest bone has been found: it points ahead
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const bool longest = !pointed && problem.lengths()[i] == problem.scratch.longest;
        pointed = pointed || longest;
        const bool forward = can.status == Status::Stretched || longest;
        const glm::quat turned = transported(scratch.pose.rotations[i], scratch.pose.directions[i],
                                             times(ahead, forward ? 1.0f : -1.0f));
        pose.local[i] = compose(conjugate(parent_of(scratch, pose.rotations, i)), turned);
        clamp(scratch.limits[i], pose.local[i]);
        place_bone(problem, pose, i);
        lost += problem.lengths()[i] * (1.0f - dot(pose.directions[i], ahead));
        if (can.status == Status::Stretched && lost > allowed) return false;
    }
    const float residual = distance(pose.joints[problem.bones()], problem.target);
    if (residual > can.residual + allowed) return false;
    if (furthest_moved(problem, scratch.pose, pose) > allowance) return false;
    accept_trial(problem, Phase::Analytic, watch);
    return true;
}

/// Reasons why the iterations ended with a pose that has not arrived.
enum class End { Stalled, StalledInDescent, StalledAtOnce, Unfinished };

Status status_of(Problem& problem, const Reachable& can, End end) noexcept {
    if (arrived(problem, can)) return can.status;
    if (end == End::Unfinished) return Status::IterationLimit;
    // As near as floats can resolve or, out of reach, about as near as a chain that is still straightening.
    const float reach = problem.scratch.reach;
    const float converged = std::max(
        problem.tolerance, can.status == Status::Converged ? 1e-5f * reach : can.residual + 1e-3f * reach);
    if (end == End::Stalled) return limits_stop_tip(problem, converged) ? Status::Limited : Status::Stalled;
    if (error_of(problem, problem.scratch.limited.pose) <= converged) return Status::Stalled;
    const PoseUsed pose_used = end == End::StalledAtOnce ? PoseUsed::BeforeLastStep : PoseUsed::Current;
    return is_stopped_by_limits(problem, pose_used) ? Status::Limited : Status::Stalled;
}

/// The loop's state besides the pose: `best` is the error of scratch.best.
struct Attempt {
    Reachable can;
    float best = 0.0f;
    bool dragged = false;  ///< continues the last solve, for a target that moved little
    float allowance = std::numeric_limits<float>::infinity();  ///< maximum move of a joint, metres
};

void save_if_nearer(Problem& problem, Attempt& attempt) noexcept {
    const float error = error_of(problem, problem.scratch.limited.pose);
    if (!(error < attempt.best)) return;
    attempt.best = error;
    problem.scratch.limited.best = problem.scratch.limited.pose;
}

/// Detects whether this continues the last solve: the same method and chain, and a target nearby.
void detect_drag(Method method, const Problem& problem, bool unchanged, Attempt& attempt) noexcept {
    const LimitMemory& memory = problem.state.limits;
    if (method != Method::Fabrik || !memory.valid || !unchanged || problem.options.restarts) return;
    const float step = distance(minus(problem.target, problem.root()), memory.target);
    attempt.dragged = step <= tune::limits::dragged * problem.scratch.reach;
    if (attempt.dragged) attempt.allowance = tune::limits::follow * (step + problem.tolerance);
}

template <class Watch>
Attempt prepare_attempt(Method method, Problem& problem, Watch watch) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    if (problem.options.pole) problem.scratch.pole.allowance = pole_allowance(problem);
    const bool unchanged = load_pose(problem, watch);
    Attempt attempt{reachable(problem), error_of(problem, scratch.pose)};
    scratch.best = scratch.pose;
    if (problem.options.snap_back > 0.0f) {
        commit(problem);
        snap_back(problem, problem.options.snap_back, watch);
        load_pose(problem, watch);
    }
    detect_drag(method, problem, unchanged, attempt);
    scratch.start = scratch.pose;
    problem.closed_form = straighten_within_limits(problem, attempt.can, attempt.allowance, watch);
    save_if_nearer(problem, attempt);
    return attempt;
}

template <class Watch>
void report_iteration(const Problem& problem, Watch watch) noexcept {
    const std::span<float> residuals = problem.options.residuals;
    const auto done = static_cast<std::size_t>(problem.iteration);
    const float residual = distance(problem.scratch.limited.pose.joints[problem.bones()], problem.goal);
    if (done >= 1 && done <= residuals.size()) residuals[done - 1] = residual;
    watch.iteration_done(problem.iteration, residual);
}

/// Bends a chain in a singular pose, at most once per solve. Returns whether it was bent.
template <class Watch>
bool bend_if_singular(Problem& problem, Watch watch) noexcept {
    if (problem.perturbations > 0 || !is_singular(problem)) return false;
    bend_within_limits(problem, watch);
    ++problem.perturbations;
    return true;
}

/// Selects another pose after a stalled descent. Returns whether there is one.
template <class Watch>
bool next_start(Problem& problem, Attempt& attempt, Watch watch) noexcept {
    save_if_nearer(problem, attempt);
    // If its limits keep a chain stretched towards a dragged target, an earlier solve has bent it in vain.
    const bool fixed = attempt.dragged && problem.state.limits.limited;
    if (!fixed && bend_if_singular(problem, watch)) return true;
    const int maximum = problem.options.restarts.value_or(attempt.dragged ? 0 : default_restarts);
    if (problem.restarts >= maximum) return false;
    sample(problem, ++problem.restarts);
    accept_trial(problem, Phase::Prepare, watch);
    return true;
}

/// Descent (FABRIK and least squares) with restarts.
template <class Watch>
End solve_with_restarts(Problem& problem, Attempt& attempt, Watch watch) noexcept {
    LimitMemory& memory = problem.state.limits;
    LimitedDescent descent(problem, attempt.allowance);
    const bool continued = attempt.dragged && memory.limited;  // continues a stalled descent
    if (attempt.dragged) descent.continue_from(memory.damping, continued);
    bool over = false;
    while (problem.iteration < problem.options.max_iterations) {
        const bool converged = arrived(problem, attempt.can);
        if (!converged && !over && descent.stalled()) {
            over = !next_start(problem, attempt, watch);
            if (!over) descent.restart(problem);
        }
        if ((converged || over) && !problem.options.every_iteration) break;
        ++problem.iteration;
        descent.iterate(problem, watch);
        report_iteration(problem, watch);
    }
    save_if_nearer(problem, attempt);
    memory = {true, false, minus(problem.target, problem.root()), descent.damping()};
    over = over || descent.stalled() || problem.restarts > 0;
    if (!over || descent.exceeds_allowance()) return End::Unfinished;
    return continued && problem.iteration == 1 ? End::StalledAtOnce : End::StalledInDescent;
}

/// A method without restarts.
template <class Watch>
End continue_from(Method method, Problem& problem, Attempt& attempt, Watch watch) noexcept {
    problem.state.limits.valid = false;
    Convergence convergence(stall, attempt.best, problem.scratch.reach);
    bool stalled = false;
    const bool bends = method != Method::FabrikPlain;
    while (problem.iteration < problem.options.max_iterations) {
        const bool converged = arrived(problem, attempt.can);
        stalled = stalled || convergence.stalled();
        const bool stalls = !converged && (problem.iteration == 0 || convergence.stalled());
        if (stalls && bends && bend_if_singular(problem, watch))
            convergence.restart(error_of(problem, problem.scratch.limited.pose));
        if ((converged || convergence.stalled()) && !problem.options.every_iteration) break;
        ++problem.iteration;
        limited_iteration(method, problem, watch);
        save_if_nearer(problem, attempt);
        convergence.record(error_of(problem, problem.scratch.limited.pose));
        report_iteration(problem, watch);
    }
    return stalled || convergence.stalled() ? End::Stalled : End::Unfinished;
}

}  // namespace

template <class Watch>
Report run_limited(Method method, Problem& problem, Watch watch) noexcept {
    if (!(problem.scratch.reach > 0.0f)) {
        load_pose(problem, watch);
        report_iteration(problem, watch);
        commit(problem);
        const bool converged = limited_residual(problem) <= problem.tolerance;
        return {converged ? Status::Converged : Status::Stretched, 0, limited_residual(problem)};
    }
    Attempt attempt = prepare_attempt(method, problem, watch);
    report_iteration(problem, watch);
    const End end = method == Method::Fabrik ? solve_with_restarts(problem, attempt, watch)
                                             : continue_from(method, problem, attempt, watch);
    const bool converged = limited_residual(problem) <= problem.tolerance && is_turned(problem);
    if (!converged && error_of(problem, problem.scratch.limited.pose) != attempt.best) {
        problem.scratch.limited.trial = problem.scratch.limited.best;
        accept_trial(problem, Phase::RestoreBest, watch);
    }
    commit(problem);
    face_pole_within_limits(problem, watch);
    const Status status = status_of(problem, attempt.can, end);
    problem.state.limits.limited = status == Status::Limited || status == Status::Stalled;
    return problem.report(status, limited_residual(problem));
}

template Report run_limited(Method, Problem&, Unwatched) noexcept;
template Report run_limited(Method, Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
