#include "ik/solve/tip.hpp"

#include <algorithm>

#include "ik/math.hpp"
#include "ik/solve/loop.hpp"
#include "ik/solve/prepare.hpp"
#include "ik/solve/reachability.hpp"
#include "ik/solve/rotations.hpp"

namespace tendril::ik::detail {
namespace {

/// While it lives the room is that of the chain without its last bone.
class Shortened {
  public:
    explicit Shortened(Workspace& room) noexcept : room_(room), reach_(room.reach), longest_(room.longest) {
        double reach = 0.0;
        room_.longest = 0.0f;
        for (std::size_t i = 0; i + 1 < room_.lengths.size(); ++i) {
            reach += static_cast<double>(room_.lengths[i]);
            room_.longest = std::max(room_.longest, room_.lengths[i]);
        }
        room_.reach = static_cast<float>(reach);
    }
    ~Shortened() { room_.reach = reach_, room_.longest = longest_; }
    Shortened(const Shortened&) = delete;
    Shortened& operator=(const Shortened&) = delete;

  private:
    Workspace& room_;
    float reach_, longest_;
};

/// What the last bone is, from its start to the tip.
glm::vec3 last_bone(const Problem& problem, const glm::quat& orientation) noexcept {
    const std::size_t last = problem.bones() - 1;
    const glm::vec3 along = rotated(orientation, problem.room.rest_directions[last]);
    return times(along, problem.lengths()[last] / length(along));
}

/// Nothing is left to solve for: one bone, or others without length.
template <class Watch>
Report only_last(Problem& rest, Watch watch) noexcept {
    lay_to_lengths(rest, watch);
    Report report;
    report.residual = exact_distance(rest.joints.back(), rest.target);
    if (report.residual > rest.tolerance) report.status = Status::Stretched;
    watch.iteration_done(0, report.residual);
    return report;
}

}  // namespace

template <class Watch>
Report run_turned(Method method, Problem& problem, Watch watch) noexcept {
    const glm::quat& asked = *problem.options.tip_orientation;
    const glm::quat orientation = unit_quaternion(asked.w, asked.x, asked.y, asked.z);
    const glm::vec3 bone = last_bone(problem, orientation);
    Options options = problem.options;
    options.tip_orientation.reset();
    options.rotations = false;  // carried at the end
    Report report;
    {
        const Shortened shortened(problem.room);
        Problem rest{problem.joints.first(problem.bones()),
                     minus(problem.target, bone),
                     problem.tolerance,
                     options,
                     problem.room,
                     problem.state};
        // A single bone is as well laid by any method; the two-bone one would not take it.
        const bool fits = method != Method::TwoBone || rest.bones() == 2;
        report = problem.room.reach > 0.0f ? run(fits ? method : Method::Fabrik, rest, watch)
                                           : only_last(rest, watch);
        problem.iteration = rest.iteration;
        problem.stretch = rest.stretch;
    }
    const std::size_t last = problem.bones();
    const glm::vec3 from = problem.joints[last], to = plus(problem.joints[last - 1], bone);
    problem.joints[last] = to;
    watch.moved(problem.iteration, Phase::Analytic, last, last - 1, from, to);
    watch.next_step();
    carry_rotations(problem);
    problem.state.rotations[problem.bones() - 1] = orientation;
    report.residual = exact_distance(to, problem.target);
    if (report.status == Status::Converged && report.residual > problem.tolerance * 1.01f) {
        report.status = Status::Stalled;  // further out than floats can tell
    }
    return report;
}

template Report run_turned(Method, Problem&, Unwatched) noexcept;
template Report run_turned(Method, Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
