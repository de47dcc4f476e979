// Cyclic coordinate descent: one joint after the other, from the tip to the root, turns so that the tip lies
// on its line to the target.
//
// Source: L.-C. T. Wang, C. C. Chen, "A combined optimization method for solving the inverse kinematics
// problem of mechanical manipulators", IEEE Transactions on Robotics and Automation 7(4), 1991.
//
// Cost: O(n) per iteration. While a joint turns, those nearer to the root do not move; so the pass that finds
// the rotations moves only the tip, and a second one applies all rotations.
//
// It converges to any target within reach, but slowly near full reach. It curls the bones near the tip first:
// a joint there rotates as freely as one at the root, and comes first.
#include "ik/methods/methods.hpp"

#include <algorithm>

#include "ik/methods/rotations.hpp"

namespace tendril::ik::detail {
namespace {

constexpr glm::quat no_rotation{1.0f, 0.0f, 0.0f, 0.0f};

/// Reports the rotation of one joint before the others follow: scratch.old is the pose that the observer has
/// seen.
template <class Watch>
void show_rotation(Problem& problem, std::size_t joint, Watch watch) noexcept {
    std::vector<glm::vec3>& seen = problem.scratch.old;
    const glm::vec3 at = seen[joint];
    for (std::size_t i = joint + 1; i < problem.joints.size(); ++i) {
        const glm::vec3 to = plus(at, rotated(problem.scratch.rotations[joint], minus(seen[i], at)));
        watch.moved(problem.iteration, Phase::Rotate, i, joint, seen[i], to);
        seen[i] = to;
    }
    watch.next_step();
}

/// The root's rotation comes last: it moves every joint to its exact final position.
template <class Watch>
void show_last_rotation(Problem& problem, Watch watch) noexcept {
    for (std::size_t i = 1; i < problem.joints.size(); ++i) {
        watch.moved(problem.iteration, Phase::Rotate, i, 0, problem.scratch.old[i], problem.joints[i]);
    }
    watch.next_step();
}

}  // namespace

glm::quat rotation_towards(const Problem& problem, const glm::vec3& at, const glm::vec3& tip,
                           const glm::vec3& target) noexcept {
    // Differences of coordinates have an error of about 1e-7 of the reach; an arm of a tenth of this would be
    // noise.
    const float nothing = std::max(1e-6f * problem.scratch.reach, FLT_MIN);
    const glm::vec3 to_tip = minus(tip, at), to_target = minus(target, at);
    const float a = length(to_tip), b = length(to_target);
    if (!(a > nothing && b > nothing)) return no_rotation;
    return minimal_rotation(times(to_tip, 1.0f / a), times(to_target, 1.0f / b));
}

template <class Watch>
void ccd_iteration(Problem& problem, Watch watch) noexcept {
    const std::span<glm::vec3> joints = problem.joints;
    if constexpr (Watch::watching) std::copy(joints.begin(), joints.end(), problem.scratch.old.begin());
    glm::vec3 tip = joints.back();
    for (std::size_t i = problem.bones(); i-- > 0;) {
        const glm::quat rotation = rotation_towards(problem, joints[i], tip, problem.target);
        problem.scratch.rotations[i] = rotation;
        tip = plus(joints[i], rotated(rotation, minus(tip, joints[i])));
        if constexpr (Watch::watching) {
            if (i > 0) show_rotation(problem, i, watch);
        }
    }
    apply_rotations(problem);
    if constexpr (Watch::watching) show_last_rotation(problem, watch);
}

template void ccd_iteration(Problem&, Unwatched) noexcept;
template void ccd_iteration(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
