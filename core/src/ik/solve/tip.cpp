#include "ik/solve/tip.hpp"

#include <algorithm>

#include "ik/math.hpp"
#include "ik/solve/loop.hpp"
#include "ik/solve/prepare.hpp"
#include "ik/solve/reachability.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

/// During its lifetime the workspace describes the chain without its last bone.
class WithoutLastBone {
  public:
    explicit WithoutLastBone(Workspace& scratch) noexcept
        : scratch_(scratch), reach_(scratch.reach), longest_(scratch.longest) {
        double reach = 0.0;
        scratch_.longest = 0.0f;
        for (std::size_t i = 0; i + 1 < scratch_.lengths.size(); ++i) {
            reach += static_cast<double>(scratch_.lengths[i]);
            scratch_.longest = std::max(scratch_.longest, scratch_.lengths[i]);
        }
        scratch_.reach = static_cast<float>(reach);
    }
    ~WithoutLastBone() { scratch_.reach = reach_, scratch_.longest = longest_; }
    WithoutLastBone(const WithoutLastBone&) = delete;
    WithoutLastBone& operator=(const WithoutLastBone&) = delete;

  private:
    Workspace& scratch_;
    float reach_, longest_;
};

/// Vector from the start of the last bone to the tip.
glm::vec3 last_bone(const Problem& problem, const glm::quat& orientation) noexcept {
    const std::size_t last = problem.bones() - 1;
    const glm::vec3 along = rotated(orientation, problem.scratch.rest_directions[last]);
    return times(along, problem.lengths()[last] / length(along));
}

/// Solves chains with nothing left to solve: only one bone, or the others have no length.
template <class Watch>
Report solve_last_bone(Problem& rest, Watch watch) noexcept {
    enforce_lengths(rest, watch);
    Report report;
    report.residual = exact_distance(rest.joints.back(), rest.target);
    if (report.residual > rest.tolerance) report.status = Status::Stretched;
    watch.iteration_done(0, report.residual);
    return report;
}

}  // namespace

template <class Watch>
Report run_with_tip_orientation(Method method, Problem& problem, Watch watch) noexcept {
    const glm::quat& requested = *problem.options.tip_orientation;
    const glm::quat orientation = unit_quaternion(requested.w, requested.x, requested.y, requested.z);
    const glm::vec3 bone = last_bone(problem, orientation);
    Options options = problem.options;
    options.tip_orientation.reset();
    options.rotations = false;  // transported at the end
    Report report;
    {
        const WithoutLastBone shortened(problem.scratch);
        Problem rest{problem.joints.first(problem.bones()),
                     minus(problem.target, bone),
                     problem.tolerance,
                     options,
                     problem.scratch,
                     problem.state};
        // One bone is solved equally well by any method; the two-bone solver would refuse it.
        const bool fits = method != Method::TwoBone || rest.bones() == 2;
        report = problem.scratch.reach > 0.0f ? run(fits ? method : Method::Fabrik, rest, watch)
                                              : solve_last_bone(rest, watch);
        problem.iteration = rest.iteration;
        problem.stretch = rest.stretch;
    }
    const std::size_t last = problem.bones();
    const glm::vec3 from = problem.joints[last], to = plus(problem.joints[last - 1], bone);
    problem.joints[last] = to;
    watch.moved(problem.iteration, Phase::Analytic, last, last - 1, from, to);
    watch.next_step();
    transport_rotations(problem);
    problem.state.rotations[problem.bones() - 1] = orientation;
    report.residual = exact_distance(to, problem.target);
    if (report.status == Status::Converged && report.residual > problem.tolerance * 1.01f) {
        report.status = Status::Stalled;  // further out than floats can resolve
    }
    return report;
}

template Report run_with_tip_orientation(Method, Problem&, Unwatched) noexcept;
template Report run_with_tip_orientation(Method, Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
