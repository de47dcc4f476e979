// The turn of a linkage: drives it through its whole assembly mode.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {
namespace {

constexpr int turn_steps = 120;  ///< steps per turn, or along a slider's travel

LinkageTurn::Pose pose_of(const ik::LinkageSolver& solver, const ik::LinkageState& state, std::size_t joint) {
    LinkageTurn::Pose pose{.value = state.joints[joint].value};
    for (const ik::JointPlace& each : state.joints) pose.joints.push_back(each.value);
    pose.links.assign(solver.links().begin(), solver.links().end());
    return pose;
}

/// Drives the joint from the present pose until it has gone round or cannot go on.
std::vector<LinkageTurn::Pose> swept(ik::LinkageSolver& solver, ik::LinkageState state, std::size_t joint,
                                     double step) {
    std::vector<LinkageTurn::Pose> poses;
    double value = state.joints[joint].value;
    for (int i = 0; i < turn_steps; ++i) {
        const double before = state.joints[joint].value;
        value += step;
        const ik::LinkDriver driver{joint, value};
        const ik::LinkageReport report = solver.solve(state, {{&driver, 1}, {}});
        if (std::abs(state.joints[joint].value - before) > 1e-9)
            poses.push_back(pose_of(solver, state, joint));
        if (report.status != ik::LinkageStatus::Reached) break;
    }
    return poses;
}

/// Whether a pose lies between two neighbours of the turn. Compares joint values, since the paths of two
/// assembly modes may cross.
bool is_on(const LinkageTurn& turn, const ik::LinkageState& state, const ik::Linkage& linkage, double size) {
    const auto between = [&](const LinkageTurn::Pose& a, const LinkageTurn::Pose& b) {
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
    const std::size_t count = turn.poses.size();
    for (std::size_t i = 0; i + (turn.whole ? 0 : 1) < count; ++i)
        if (between(turn.poses[i], turn.poses[(i + 1) % count])) return true;
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

const LinkageTurn& LinkageRuntime::turn(const LinkagePart& part) {
    const std::optional<std::size_t> leading = leading_joint(part);
    if (!leading || part.result.freedom.actual != 1 || !part.result.open_closures.empty()) {
        turn_of_ = nullptr;
        turn_ = {};
        return turn_;
    }
    const std::size_t joint = *leading;
    ik::LinkageSolver& of = solver(part.shape);
    // The other assembly mode has its own turn.
    if (turn_of_ == part.shape && turn_.joint == joint && is_on(turn_, part.state, part.linkage(), of.size()))
        return turn_;
    turn_of_ = part.shape;
    turn_ = {.joint = joint};
    const bool hinge = part.linkage().links[joint].joint == ik::LinkJoint::Hinge;
    const double step = hinge ? 2.0 * std::numbers::pi / turn_steps : 2.0 * of.size() / turn_steps;
    turn_.poses = swept(of, part.state, joint, step);
    turn_.whole = hinge && turn_.poses.size() == turn_steps;
    if (turn_.whole) return turn_;
    std::vector<LinkageTurn::Pose> back = swept(of, part.state, joint, -step);
    std::ranges::reverse(back);
    static_cast<void>(of.place(part.state));
    back.push_back(pose_of(of, part.state, joint));
    turn_.poses.insert(turn_.poses.begin(), std::make_move_iterator(back.begin()),
                       std::make_move_iterator(back.end()));
    return turn_;
}

std::vector<PathPoint> LinkageRuntime::path(const LinkagePart& part) {
    const auto point = part.linkage().find_point(part.selected);
    std::vector<PathPoint> path;
    if (!point || part.linkage().points[*point].link == ik::ground_link) return path;
    const ik::LinkPoint& drawn = part.linkage().points[*point];
    const std::vector<LinkageTurn::Pose>& poses = turn(part).poses;
    for (const LinkageTurn::Pose& each : poses) path.push_back({each.links[drawn.link].point(drawn.at)});
    for (std::size_t i = 1; i < path.size(); ++i)
        path[i].speed =
            glm::distance(path[i].at, path[i - 1].at) / std::abs(poses[i].value - poses[i - 1].value);
    if (path.size() > 1) path.front().speed = path[1].speed;
    return path;
}

}  // namespace tendril::app
