// The turn of a linkage: drives it through its whole assembly mode.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <numeric>

#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/linkage/measures.hpp"

namespace tendril::app {
namespace {

constexpr int turn_steps = 120;  ///< minimum, per turn or along a slider's travel

LinkageTurn::Pose pose_of(const ik::LinkageSolver& solver, const ik::LinkageState& state, std::size_t joint) {
    LinkageTurn::Pose pose{.value = state.joints[joint].value};
    for (const ik::JointPlace& each : state.joints) pose.joints.push_back(each.value);
    pose.links.assign(solver.links().begin(), solver.links().end());
    return pose;
}

/// Drives the joint from the present pose by `far`, or until it cannot continue. Takes shorter steps where a
/// point moves fast, as next to a dead point.
std::vector<LinkageTurn::Pose> swept(ik::LinkageSolver& solver, ik::LinkageState state, std::size_t joint,
                                     double far) {
    constexpr std::size_t max_poses = 4000;  // bounds the work; no real turn has needed that many
    constexpr double max_move = 0.02;        // of the linkage's size: some 15 pixels of a view that it fills
    const double step = far / turn_steps, min_step = std::abs(step) / 4096.0;
    std::vector<LinkageTurn::Pose> poses;
    std::vector<glm::dvec3> points(solver.linkage().points.size());
    const auto move = [&] {  // the furthest that a point moves to the solver's pose
        double most = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i)
            most = std::max(most, glm::distance(points[i], solver.point(i)));
        return most;
    };
    static_cast<void>(solver.place(state));
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = solver.point(i);
    double gone = 0.0, by = step;
    const double start = state.joints[joint].value;
    while (std::abs(far - gone) > 0.5 * min_step && poses.size() < max_poses) {
        by = std::copysign(std::min(std::abs(by), std::abs(far - gone)), far);
        ik::LinkageState next = state;
        const ik::LinkDriver driver{joint, start + gone + by};
        const ik::LinkageReport report = solver.solve(next, {{&driver, 1}, {}});
        if (move() > max_move * solver.size() && std::abs(by) > min_step) {
            by *= 0.5;
            continue;
        }
        for (std::size_t i = 0; i < points.size(); ++i) points[i] = solver.point(i);
        if (std::abs(next.joints[joint].value - state.joints[joint].value) > 1e-9)
            poses.push_back(pose_of(solver, next, joint));
        if (report.status != ik::LinkageStatus::Reached) break;
        state = std::move(next);
        gone += by;
        by = std::copysign(std::min(2.0 * std::abs(by), std::abs(step)), far);
    }
    return poses;
}

/// True if a pose lies between two neighbours of the turn. Compares joint values, since the paths of two
/// assembly modes may cross.
bool is_on(const LinkageTurn& turn, const ik::LinkageState& state, const ik::Linkage& linkage, double size) {
    const auto between = [&](const LinkageTurn::Pose& a, const LinkageTurn::Pose& b) {
        for (std::size_t i = 0; i < linkage.links.size(); ++i) {
            const bool hinge = linkage.links[i].joint == ik::LinkJoint::Hinge;
            // Tolerance of a value beyond two neighbours; next to a dead point, two modes differ by no more.
            const double margin = hinge ? 0.005 : 0.0025 * size;
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
    const double far = hinge ? 2.0 * std::numbers::pi : 2.0 * of.size();
    turn_.poses = swept(of, part.state, joint, far);
    turn_.whole = hinge && !turn_.poses.empty() &&
                  std::abs(turn_.poses.back().value - part.state.joints[joint].value - far) < 1e-6;
    if (turn_.whole) return turn_;
    std::vector<LinkageTurn::Pose> back = swept(of, part.state, joint, -far);
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
    if (poses.empty()) return path;
    for (const LinkageTurn::Pose& each : poses) path.push_back({each.links[drawn.link].point(drawn.at)});
    const std::string& joint = part.linkage().links[turn_.joint].name;
    const LinkageDrive* const drive = part.find_drive(joint);
    const double rate =
        std::abs(drive != nullptr && is_running(*drive) ? drive->rate : usual_motor_rate(part, joint, *this));
    for (std::size_t i = 1; i < path.size(); ++i)
        path[i].speed =
            rate * glm::distance(path[i].at, path[i - 1].at) / std::abs(poses[i].value - poses[i - 1].value);
    if (path.size() > 1) path.front().speed = path[1].speed;
    return path;
}

namespace {

/// The field of a preset's length that sets its crank; null for a linkage drawn by hand.
const Field* crank_field(const LinkagePart& part, const ik::SketchMotor& motor) {
    for (const Field& each : mechanism_fields(part.shape->mechanism).table)
        if (file_name(each) == part.shape->sketch.bars[motor.bar].name) return &each;
    return nullptr;
}

/// True if the motor turns all the way round with a crank of this length, set as a command does.
bool goes_round(LinkagePart part, const ik::SketchMotor& motor, double crank) {
    LinkageRuntime runtime;
    try {
        if (const Field* const field = crank_field(part, motor)) {
            Mechanism mechanism = part.shape->mechanism;
            field->set_number(mechanism_fields(mechanism).object, crank);
            take_shape(part, shape_of(mechanism), runtime);
        } else {
            ik::LinkageSketch sketch = present_sketch(part);
            set_bar_length(sketch, motor.bar, crank);
            take_shape(part, shape_of(std::move(sketch)), runtime);
        }
    } catch (const std::exception&) {  // the other bars do not allow it
        return false;
    }
    return runtime.turn(part).whole;
}

std::optional<RoundCrank> shorter_round_crank(const LinkagePart& part, const ik::SketchMotor& motor) {
    const ik::SketchBar& bar = part.shape->sketch.bars[motor.bar];
    const bool alone = std::ranges::count(part.shape->bodies, part.shape->bodies[motor.bar]) == 1;
    const bool preset = kind_of(part.shape->mechanism) != nullptr;
    if (!alone || bar.points.size() != 2 || motor.against != ik::ground_link ||
        part.linkage().find_link(motor.name) != leading_joint(part) || part.result.freedom.actual != 1 ||
        (preset && crank_field(part, motor) == nullptr))
        return std::nullopt;
    const double now = glm::distance(part.at(bar.points[0]), part.at(bar.points[1]));
    constexpr int parts = 20;  // the lengths tried: coarse, then halved to a thousandth
    for (int i = parts - 1; i > 0; --i) {
        RoundCrank crank{now * i / parts, now * i / parts};
        if (!goes_round(part, motor, crank.length)) continue;
        double folds = crank.longest + now / parts;
        for (int half = 0; half < 6; ++half) {
            const double middle = 0.5 * (crank.longest + folds);
            (goes_round(part, motor, middle) ? crank.longest : folds) = middle;
        }
        // Whole centimetres, 5 % below the length at which it folds.
        const double shorter = 0.01 * std::floor(95.0 * crank.longest);
        if (shorter > 0.0 && goes_round(part, motor, shorter)) crank.length = shorter;
        return crank;
    }
    return std::nullopt;
}

}  // namespace

std::optional<RoundCrank> LinkageRuntime::round_crank(const LinkagePart& part, std::size_t motor) {
    if (crank_of_ == part.shape && crank_at_ == part.state && crank_motor_ == motor) return crank_;
    crank_of_ = part.shape;
    crank_at_ = part.state;
    crank_motor_ = motor;
    const ik::SketchMotor& of = part.shape->sketch.motors[motor];
    crank_ = shorter_round_crank(part, of);
    const std::vector<LinkageTurn::Pose>& poses = turn(part).poses;
    if (crank_ || poses.empty()) return crank_;
    const double middle = std::midpoint(poses.front().value, poses.back().value);
    LinkagePart driven = part;
    for (LinkageDrive& each : driven.drives)
        if (each.joint == of.name) each.value = middle;
    solve_linkage(driven, *this);
    if ((crank_ = shorter_round_crank(driven, of))) crank_->from = middle;
    return crank_;
}

}  // namespace tendril::app
