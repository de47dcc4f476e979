// The path of a point: the linkage is driven through all of its assembly mode.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {
namespace {

constexpr int turn_steps = 120;  ///< of a whole turn, or along a slider

std::vector<double> values_of(const ik::LinkageState& state) {
    std::vector<double> values;
    for (const ik::JointPlace& each : state.joints) values.push_back(each.value);
    return values;
}

/// Drives the joint on from the present pose until it is round, or cannot go on.
std::vector<PathPoint> swept(ik::LinkageSolver& solver, ik::LinkageState state, std::size_t joint,
                             std::size_t point, double step) {
    std::vector<PathPoint> path;
    static_cast<void>(solver.place(state));
    glm::dvec3 before = solver.point(point);
    double value = state.joints[joint].value;
    for (int i = 0; i < turn_steps; ++i) {
        value += step;
        const ik::LinkDriver driver{joint, value};
        const ik::LinkageReport report = solver.solve(state, {{&driver, 1}, {}});
        const double gone = step - (value - state.joints[joint].value);
        const bool ends = report.status != ik::LinkageStatus::Reached;
        if (std::abs(gone) > 1e-9) {
            const glm::dvec3 at = solver.point(point);
            path.push_back({at, glm::distance(at, before) / std::abs(gone), values_of(state)});
            before = at;
        }
        if (ends) break;
    }
    return path;
}

/// Whether a pose is between two neighbours of the path. Points alone do not tell: the paths of two assembly
/// modes may cross.
bool is_on(const std::vector<PathPoint>& path, const ik::LinkageState& state, const ik::Linkage& linkage,
           double size) {
    const auto between = [&](const PathPoint& a, const PathPoint& b) {
        for (std::size_t i = 0; i < linkage.links.size(); ++i) {
            const bool hinge = linkage.links[i].joint == ik::LinkJoint::Hinge;
            const double margin = hinge ? 0.02 : 0.01 * size;
            const auto from_a = [&](double value) {
                const double by = value - a.joints[i];
                return hinge ? std::remainder(by, 2.0 * std::numbers::pi) : by;
            };
            const double end = from_a(b.joints[i]), at = from_a(state.joints[i].value);
            if (at < std::min(end, 0.0) - margin || at > std::max(end, 0.0) + margin) return false;
        }
        return true;
    };
    for (std::size_t i = 0; i < path.size(); ++i)
        if (between(path[i], path[(i + 1) % path.size()])) return true;
    return false;
}

}  // namespace

std::optional<std::size_t> leading_joint(const LinkagePart& part) {
    const ik::Linkage& linkage = part.linkage();
    if (!part.drives.empty()) return linkage.find_link(part.drives.front().joint);
    for (std::size_t i = 0; i < linkage.links.size(); ++i)
        if (linkage.links[i].parent == ik::ground_link && linkage.links[i].joint != ik::LinkJoint::Ball)
            return i;
    return std::nullopt;
}

const std::vector<PathPoint>& LinkageRuntime::path(const LinkagePart& part) {
    const auto point = part.linkage().find_point(part.selected), joint = leading_joint(part);
    const bool has_path = point && joint && part.linkage().points[*point].link != ik::ground_link &&
                          part.result.freedom.actual == 1 && part.result.open_closures.empty();
    if (!has_path) {
        path_of_ = nullptr;
        path_.clear();
        return path_;
    }
    ik::LinkageSolver& of = solver(part.shape);
    // The other assembly mode has a path of its own.
    if (path_of_ == part.shape && path_point_ == part.selected &&
        is_on(path_, part.state, part.linkage(), of.size()))
        return path_;
    path_of_ = part.shape;
    path_point_ = part.selected;
    const bool hinge = part.linkage().links[*joint].joint == ik::LinkJoint::Hinge;
    const double step = hinge ? 2.0 * std::numbers::pi / turn_steps : 2.0 * of.size() / turn_steps;
    path_ = swept(of, part.state, *joint, *point, step);
    if (!hinge || path_.size() < turn_steps) {
        std::vector<PathPoint> back = swept(of, part.state, *joint, *point, -step);
        std::ranges::reverse(back);
        back.push_back({part.at(*point), path_.empty() ? 0.0 : path_.front().speed, values_of(part.state)});
        path_.insert(path_.begin(), back.begin(), back.end());
    }
    return path_;
}

}  // namespace tendril::app
