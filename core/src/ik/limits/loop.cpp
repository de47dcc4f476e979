// The loop around solves with limits.
#include "ik/limits/loop.hpp"

#include <algorithm>

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
bool lie_on_line(Problem& problem, const Reachable& can, Watch watch) noexcept {
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

Status status_of(Problem& problem, const Reachable& can, bool stalled) noexcept {
    if (arrived(problem, can)) return can.status;
    if (!stalled) return Status::IterationLimit;
    // As near as floats come, and out of reach about as near as a chain comes that is still straightening.
    const float reach = problem.room.reach;
    const float there = can.status == Status::Converged ? 1e-5f * reach : can.residual + 1e-3f * reach;
    return limits_hold(problem, std::max(problem.tolerance, there)) ? Status::Limited : Status::Stalled;
}

/// What the loop knows besides the pose: room.limited.nearest has the error `best`.
struct Course {
    Reachable can;
    float best = 0.0f;
};

void note_if_nearer(Problem& problem, Course& course) noexcept {
    const float error = error_of(problem, problem.room.limited.pose);
    if (!(error < course.best)) return;
    course.best = error;
    problem.room.limited.best = problem.room.limited.pose;
}

template <class Watch>
Course prepare(Problem& problem, Watch watch) noexcept {
    expect_pole(problem);
    take_limits(problem);
    take_pose(problem, watch);
    Course course{reachable(problem), error_of(problem, problem.room.limited.pose)};
    problem.room.limited.best = problem.room.limited.pose;
    if (problem.options.snap_back > 0.0f) {
        commit(problem);
        snap_back(problem, watch);
        take_pose(problem, watch);
    }
    problem.closed_form = lie_on_line(problem, course.can, watch);
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

/// Whether it stalled.
template <class Watch>
bool search(Problem& problem, Course& course, Watch watch) noexcept {
    LimitedSearch search(error_of(problem, problem.room.limited.pose));
    while (problem.iteration < problem.options.max_iterations) {
        const bool over = arrived(problem, course.can) || search.exhausted();
        if (over && !problem.options.every_iteration) break;
        ++problem.iteration;
        search.iterate(problem, watch);
        if (search.takes(error_of(problem, problem.room.limited.pose), course.best,
                         arrived(problem, course.can))) {
            note_if_nearer(problem, course);
        }
        tell(problem, watch);
    }
    return search.stalled();
}

/// Bends a chain from which no way leads on, until one does. Whether it was bent.
template <class Watch>
bool leave_singular(Problem& problem, int& kicks, Watch watch) noexcept {
    const int before = kicks;
    while (kicks < most_kicks && is_singular(problem)) kick_within_limits(problem, kicks++, watch);
    problem.perturbations += kicks - before;
    return kicks > before;
}

/// The same by a method that has no second try.
template <class Watch>
bool go_on(Method method, Problem& problem, Course& course, Watch watch) noexcept {
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
    return stalled || progress.stalled();
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
    Course course = prepare(problem, watch);
    tell(problem, watch);
    const bool stalled =
        method == Method::Fabrik ? search(problem, course, watch) : go_on(method, problem, course, watch);
    const bool there = residual_of(problem) <= problem.tolerance && is_turned(problem);
    if (!there && error_of(problem, problem.room.limited.pose) != course.best) {
        problem.room.limited.trial = problem.room.limited.best;
        take_trial(problem, Phase::Keep, watch);
    }
    commit(problem);
    face_pole_within_limits(problem, watch);
    return problem.report(status_of(problem, course.can, stalled), residual_of(problem));
}

template Report run_limited(Method, Problem&, Unwatched) noexcept;
template Report run_limited(Method, Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
