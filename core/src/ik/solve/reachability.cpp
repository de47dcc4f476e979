#include "ik/solve/reachability.hpp"

#include <cfloat>

namespace tendril::ik::detail {

Reachability reachability_of(const Problem& problem) noexcept {
    double reach = 0.0;
    for (const float bone : problem.lengths()) reach += static_cast<double>(bone);
    return Reachability::of(reach, static_cast<double>(problem.scratch.longest));
}

template <class Watch>
std::optional<Report> answer_beyond_reach(Problem& problem, Watch watch) noexcept {
    const Reachability can = reachability_of(problem);
    const double distance = length(between(problem.root(), problem.target));
    const double equal = std::max(1e-6 * can.furthest, DBL_MIN);  // over 0 even for a chain of zero length
    Status status = can.status(distance, -equal);
    if (status == Status::Converged) return std::nullopt;
    const auto length_of = [&](std::size_t i) { return problem.lengths()[i]; };
    const auto place = [&](std::size_t joint, const glm::vec3& to) {
        watch.moved(0, Phase::Analytic, joint, joint - 1, problem.joints[joint], to);
        watch.next_step();
        problem.joints[joint] = to;
    };
    if (status == Status::Stretched) {
        straighten(problem.joints, problem.target, length_of, place);
    } else {
        fold(problem.joints, problem.target, can.nearest, length_of, place);
    }
    problem.closed_form = true;
    const float residual = exact_distance(problem.joints.back(), problem.target);
    const bool reachable = can.status(distance, equal) == Status::Converged;
    if (reachable && residual <= problem.tolerance) status = Status::Converged;
    return problem.report(status, residual);
}

template std::optional<Report> answer_beyond_reach(Problem&, Unwatched) noexcept;
template std::optional<Report> answer_beyond_reach(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
