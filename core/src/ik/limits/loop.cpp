// The loop around solves with limits.
#include "ik/limits/loop.hpp"

#include <algorithm>
#include <limits>

#include "ik/limits/active.hpp"
#include "ik/limits/methods.hpp"
#include "ik/limits/multistart.hpp"
#include "ik/limits/perturbation.hpp"
#include "ik/limits/pole.hpp"
#include "ik/limits/pose.hpp"
#include "ik/solve/prepare.hpp"

namespace tendril::ik::detail {
namespace {

constexpr float orientation_tolerance = 1e-3f;  ///< radians
constexpr float straight_tolerance = 1e-4f;     ///< of the reach
constexpr int most_kicks = 4;                   ///< out of singular poses
constexpr int default_restarts = 8;             ///< options.hpp has what it was chosen by
constexpr float near_target = 0.05f;            ///< of the reach: a target that moved less is dragged
constexpr float follow = 20.0f;                 ///< how far joints may follow it, in steps of the target

/// Out of reach, too near for the longest bone, or neither; and what no pose can better.
struct Reachable {
    Status status = Status::Converged;
    float residual = 0.0f;
};

Reachable reachable(const Problem& problem) noexcept {
    const float away = distance(problem.root(), problem.target), reach = problem.room.reach;
    const float nearest = 2.0f * problem.room.longest - reach;
    if (away > reach) return {Status::Stretched, away - reach};
    if (away < nearest) return {Status::TooClose, nearest - away};
    return {};
}

float residual_of(const Problem& problem) noexcept {
    return distance(problem.room.limited.pose.joints[problem.bones()], problem.target);
}

bool is_turned(const Problem& problem) noexcept {
    if (!problem.options.tip_orientation) return true;
    const glm::vec3 turn = orientation_error(problem, problem.room.limited.pose);
    return length(turn) <= orientation_tolerance * 0.25f * problem.room.reach;
}

/// The tip is where it should be, or as near as any pose brings it.
bool arrived(const Problem& problem, const Reachable& can) noexcept {
    const float residual = residual_of(problem);
    const float more = can.status == Status::Converged ? 0.0f : straight_tolerance * problem.room.reach;
    return residual <= std::max(problem.tolerance, can.residual + more) && is_turned(problem);
}

/// Lays the chain straight towards the target, or folded back along its longest bone, where the limits let it
/// lie so. Whether they do.
template <class Watch>
bool lie_on_line(Problem& problem, const Reachable& can, float allowance, Watch watch) noexcept {
    if (can.status == Status::Converged || problem.options.tip_orientation) return false;
    LimitedRoom& room = problem.room.limited;
    LimitedPose& pose = room.trial;
    pose.joints[0] = problem.root();
    const glm::vec3 ahead = math::direction(problem.root(), problem.target, room.pose.directions[0]);
    bool pointed = false;  // whether a longest bone has been met: the one that points ahead
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const bool longest = !pointed && problem.lengths()[i] == problem.room.longest;
        pointed = pointed || longest;
        const bool forward = can.status == Status::Stretched || longest;
        const glm::quat turned =
            carried(room.pose.rotations[i], room.pose.directions[i], times(ahead, forward ? 1.0f : -1.0f));
        pose.turns[i] = compose(conjugate(parent_of(pose.rotations, i)), turned);
        clamp(room.limits[i], pose.turns[i]);
        extend_bone(problem, pose, i);
    }
    const float residual = distance(pose.joints[problem.bones()], problem.target);
    if (residual > can.residual + straight_tolerance * problem.room.reach) return false;
    if (furthest_moved(problem, room.pose, pose) > allowance) return false;
    take_trial(problem, Phase::Analytic, watch);
    return true;
}

/// For the methods that have no second try: they stall when the best has hardly become better for long.
class Progress {
  public:
    explicit Progress(float error) noexcept : mark_(error), best_(error) {}
    void note(float error) noexcept {
        best_ = std::min(best_, error);
        since_ = best_ < 0.999f * mark_ ? 0 : since_ + 1;
        if (since_ == 0) mark_ = best_;
    }
    /// After the chain was bent by hand: what came before no longer counts.
    void start_again(float error) noexcept {
        mark_ = best_ = error;
        since_ = 0;
    }
    bool stalled() const noexcept { return since_ >= 20; }

  private:
    float mark_;
    float best_;  ///< since the chain was last bent by hand
    int since_ = 0;
};

/// What the last iteration says of a pose that has not arrived.
enum class End { Stalled, StalledInDescent, StillOnItsWay };

Status status_of(Problem& problem, const Reachable& can, End end) noexcept {
    if (arrived(problem, can)) return can.status;
    if (end == End::StillOnItsWay) return Status::IterationLimit;
    // As near as floats come, and out of reach about as near as a chain comes that is still straightening.
    const float reach = problem.room.reach;
    const float there = std::max(
        problem.tolerance, can.status == Status::Converged ? 1e-5f * reach : can.residual + 1e-3f * reach);
    const bool limited = end == End::Stalled ? limits_hold(problem, there)
                                             : error_of(problem, problem.room.limited.pose) > there &&
                                                   stopped_by_limits(problem);
    return limited ? Status::Limited : Status::Stalled;
}

/// What the loop knows besides the pose: workspace.best has the error `best`.
struct Course {
    Reachable can;
    float best = 0.0f;
    bool dragged = false;  ///< the chain goes on from the last solve, for a target that moved little
    float allowance = std::numeric_limits<float>::infinity();  ///< how far a joint may go, metres
};

void note_if_nearer(Problem& problem, Course& course) noexcept {
    const float error = error_of(problem, problem.room.limited.pose);
    if (!(error < course.best)) return;
    course.best = error;
    problem.room.limited.best = problem.room.limited.pose;
}

/// Whether the last solve by this method goes on: from where it left the chain, for a target nearby.
void note_drag(Method method, const Problem& problem, bool as_left, Course& course) noexcept {
    const LimitMemory& memory = problem.state.limits;
    if (method != Method::Fabrik || !memory.valid || !as_left || problem.options.restarts) return;
    const float step = distance(minus(problem.target, problem.root()), memory.target);
    course.dragged = step <= near_target * problem.room.reach;
    if (course.dragged) course.allowance = follow * (step + problem.tolerance);
}

template <class Watch>
Course prepare(Method method, Problem& problem, Watch watch) noexcept {
    LimitedRoom& room = problem.room.limited;
    expect_pole(problem);
    take_limits(problem);
    const bool as_left = take_pose(problem, watch);
    Course course{reachable(problem), error_of(problem, room.pose)};
    room.best = room.pose;
    if (problem.options.snap_back > 0.0f) {
        commit(problem);
        snap_back(problem, watch);
        take_pose(problem, watch);
    }
    note_drag(method, problem, as_left, course);
    room.start = room.pose;
    problem.closed_form = lie_on_line(problem, course.can, course.allowance, watch);
    note_if_nearer(problem, course);
    return course;
}

template <class Watch>
void tell(const Problem& problem, Watch watch) noexcept {
    const std::span<float> told = problem.options.residuals;
    const auto done = static_cast<std::size_t>(problem.iteration);
    const float residual = distance(problem.room.limited.pose.joints[problem.bones()], problem.goal);
    if (done >= 1 && done <= told.size()) told[done - 1] = residual;
    watch.iteration_done(problem.iteration, residual);
}

/// Bends a chain from which no way leads on, until one does. Whether it was bent.
template <class Watch>
bool leave_singular(Problem& problem, int& kicks, Watch watch) noexcept {
    const int before = kicks;
    while (kicks < most_kicks && is_singular(problem)) kick_within_limits(problem, kicks++, watch);
    problem.perturbations += kicks - before;
    return kicks > before;
}

/// Another pose to go on from, where a descent has stalled; whether there is one.
template <class Watch>
bool find_start(Problem& problem, Course& course, int& kicks, Watch watch) noexcept {
    note_if_nearer(problem, course);
    // A chain that its limits hold stretched towards a dragged target was bent in vain when it came there.
    const bool held = course.dragged && problem.state.limits.limited;
    if (!held && leave_singular(problem, kicks, watch)) return true;
    const int most = problem.options.restarts.value_or(course.dragged ? 0 : default_restarts);
    if (problem.restarts >= most) return false;
    sample(problem, ++problem.restarts);
    take_trial(problem, Phase::Prepare, watch);
    return true;
}

/// FABRIK, least squares and multistart.
template <class Watch>
End search(Problem& problem, Course& course, Watch watch) noexcept {
    LimitMemory& memory = problem.state.limits;
    const LimitedPose& pose = problem.room.limited.pose;
    LimitedDescent descent(error_of(problem, pose), course.allowance);
    if (course.dragged && memory.limited) descent.go_on(memory.damping);
    int kicks = 0;
    bool over = false;
    while (problem.iteration < problem.options.max_iterations) {
        const bool there = arrived(problem, course.can);
        if (!there && !over && descent.stalled()) {
            over = !find_start(problem, course, kicks, watch);
            if (!over) descent.start_again(error_of(problem, pose));
        }
        if ((there || over) && !problem.options.every_iteration) break;
        ++problem.iteration;
        descent.iterate(problem, watch);
        tell(problem, watch);
    }
    note_if_nearer(problem, course);
    memory = {true, false, minus(problem.target, problem.root()), descent.damping()};
    over = over || descent.stalled() || problem.restarts > 0;
    return over && !descent.held_back() ? End::StalledInDescent : End::StillOnItsWay;
}

/// A method that has no second try.
template <class Watch>
End go_on(Method method, Problem& problem, Course& course, Watch watch) noexcept {
    problem.state.limits.valid = false;
    Progress progress(course.best);
    bool stalled = false;
    int kicks = method == Method::FabrikPlain ? most_kicks : 0;
    while (problem.iteration < problem.options.max_iterations) {
        const bool there = arrived(problem, course.can);
        stalled = stalled || progress.stalled();
        const bool waits = !there && (problem.iteration == 0 || progress.stalled());
        if (waits && leave_singular(problem, kicks, watch))
            progress.start_again(error_of(problem, problem.room.limited.pose));
        if ((there || progress.stalled()) && !problem.options.every_iteration) break;
        ++problem.iteration;
        limited_iteration(method, problem, watch);
        note_if_nearer(problem, course);
        progress.note(error_of(problem, problem.room.limited.pose));
        tell(problem, watch);
    }
    return stalled || progress.stalled() ? End::Stalled : End::StillOnItsWay;
}

}  // namespace

template <class Watch>
Report run_limited(Method method, Problem& problem, Watch watch) noexcept {
    if (!(problem.room.reach > 0.0f)) {
        take_limits(problem);
        take_pose(problem, watch);
        tell(problem, watch);
        commit(problem);
        const bool there = residual_of(problem) <= problem.tolerance;
        return {there ? Status::Converged : Status::Stretched, 0, residual_of(problem)};
    }
    Course course = prepare(method, problem, watch);
    tell(problem, watch);
    const End end =
        method == Method::Fabrik ? search(problem, course, watch) : go_on(method, problem, course, watch);
    const bool there = residual_of(problem) <= problem.tolerance && is_turned(problem);
    if (!there && error_of(problem, problem.room.limited.pose) != course.best) {
        problem.room.limited.trial = problem.room.limited.best;
        take_trial(problem, Phase::Keep, watch);
    }
    commit(problem);
    face_pole_within_limits(problem, watch);
    const Status status = status_of(problem, course.can, end);
    problem.state.limits.limited = status == Status::Limited;
    return problem.report(status, residual_of(problem));
}

template Report run_limited(Method, Problem&, Unwatched) noexcept;
template Report run_limited(Method, Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
