#include "ik/solve/reachability.hpp"

#include <algorithm>
#include <cmath>

#include "ik/math.hpp"

namespace tendril::ik::detail {
namespace {

glm::dvec3 between(const glm::vec3& from, const glm::vec3& to) noexcept {
    return minus(wide(to), wide(from));
}

glm::vec3 placed(const glm::vec3& at, const glm::dvec3& direction, double by) noexcept {
    return narrow(plus(wide(at), times(direction, by)));
}

template <class Watch>
void place(Problem& problem, std::size_t joint, const glm::vec3& to, Watch watch) noexcept {
    watch.moved(0, Phase::Analytic, joint, joint - 1, problem.joints[joint], to);
    watch.next_step();
    problem.joints[joint] = to;
}

/// Each joint straight towards the target from where the one before has really come to lie: so the roundings
/// of many joints do not add up to a bend.
template <class Watch>
void straighten(Problem& problem, Watch watch) noexcept {
    glm::dvec3 along = between(problem.root(), problem.target);
    for (std::size_t i = 1; i < problem.joints.size(); ++i) {
        const glm::dvec3 ahead = between(problem.joints[i - 1], problem.target);
        if (const double far = length(ahead); far > 0.0)
            along = {ahead.x / far, ahead.y / far, ahead.z / far};
        place(problem, i, placed(problem.joints[i - 1], along, static_cast<double>(problem.lengths()[i - 1])),
              watch);
    }
}

std::size_t longest_bone(std::span<const float> lengths) noexcept {
    return static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
}

/// Along which line the chain, folded at its longest bone, lies nearest to where it is: with c the place of
/// each joint on the line that is the direction of the sum of c * (joint - root).
glm::dvec3 nearest_line(const Problem& problem, std::size_t longest) noexcept {
    glm::dvec3 sum(0.0);
    double along = 0.0;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const auto bone = static_cast<double>(problem.lengths()[i]);
        along += i == longest ? bone : -bone;
        const glm::dvec3 arm = between(problem.root(), problem.joints[i + 1]);
        sum = plus(sum, times(arm, along));
    }
    const double far = length(sum);
    if (far > 0.0) return {sum.x / far, sum.y / far, sum.z / far};
    return wide(problem.scratch.rest_directions[longest]);
}

/// `span` is where the tip ends on its line. A target so near to the root that every line leaves the same
/// residual, to a part in 500, has no say in which: it would turn the chain about for nothing.
template <class Watch>
void fold(Problem& problem, double distance, double span, Watch watch) noexcept {
    const std::size_t longest = longest_bone(problem.lengths());
    glm::dvec3 along = between(problem.root(), problem.target);
    along = distance <= 1e-3 * span ? nearest_line(problem, longest)
                                    : glm::dvec3{along.x / distance, along.y / distance, along.z / distance};
    for (std::size_t i = 1; i < problem.joints.size(); ++i) {
        const auto bone = static_cast<double>(problem.lengths()[i - 1]);
        place(problem, i, placed(problem.joints[i - 1], along, i - 1 == longest ? bone : -bone), watch);
    }
}

}  // namespace

float exact_distance(const glm::vec3& a, const glm::vec3& b) noexcept {
    return static_cast<float>(length(between(a, b)));
}

template <class Watch>
std::optional<Report> answer_beyond_reach(Problem& problem, Watch watch) noexcept {
    double reach = 0.0;
    for (const float bone : problem.lengths()) reach += static_cast<double>(bone);
    const double distance = length(between(problem.root(), problem.target)), equal = 1e-6 * reach;
    const double nearest = 2.0 * static_cast<double>(problem.scratch.longest) - reach;
    Status status = Status::Converged;
    if (distance >= reach - equal) {
        straighten(problem, watch);
        status = Status::Stretched;
    } else if (nearest > 0.0 && distance <= nearest + equal) {
        fold(problem, distance, nearest, watch);
        status = Status::TooClose;
    } else {
        return std::nullopt;
    }
    problem.closed_form = true;
    const float residual = exact_distance(problem.joints.back(), problem.target);
    const bool reachable = distance <= reach + equal && distance >= nearest - equal;
    if (reachable && residual <= problem.tolerance) status = Status::Converged;
    return problem.report(status, residual);
}

template std::optional<Report> answer_beyond_reach(Problem&, Unwatched) noexcept;
template std::optional<Report> answer_beyond_reach(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
