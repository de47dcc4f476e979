#include "app/labs/linkage/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <map>
#include <numbers>

#include "app/io/text.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/linkage/linkage_commands.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

constexpr double no_angle = std::numeric_limits<double>::quiet_NaN();

glm::dvec2 way(const LinkagePart& part, std::size_t from, std::size_t to) {
    return glm::dvec2(part.at(to) - part.at(from));
}

/// Degrees, 0 to 180.
double between(const glm::dvec2& a, const glm::dvec2& b) {
    return glm::degrees(math::arctangent(std::abs(a.x * b.y - a.y * b.x), glm::dot(a, b)));
}

double transmission_in(const LinkagePart& part, const DrivenLoop& loop) {
    const auto fold = [](double degrees) { return std::min(degrees, 180.0 - degrees); };
    const glm::dvec2 coupler = way(part, loop.end, loop.tip);
    if (loop.has_rocker()) return fold(between(coupler, way(part, loop.end, loop.pin)));
    return 90.0 - fold(between(coupler, guide_direction(part.shape->sketch.points[loop.end])));
}

/// The four lengths if the linkage is a four-bar.
std::optional<ik::FourBar> four_bar_lengths(const LinkagePart& part) {
    const LinkageShape& shape = *part.shape;
    if (shape.loops != 1 || shape.driven.size() != 1 || !shape.driven[0].has_rocker()) return std::nullopt;
    const DrivenLoop& loop = shape.driven[0];
    const std::size_t motor = shape.sketch.motors[loop.motor].point;
    return ik::FourBar{.ground = glm::length(way(part, motor, loop.pin)),
                       .crank = glm::length(way(part, motor, loop.tip)),
                       .coupler = glm::length(way(part, loop.tip, loop.end)),
                       .rocker = glm::length(way(part, loop.end, loop.pin))};
}

/// True if the joint is a hinge in the plane without a range: whole turns then make no difference.
bool goes_round(const LinkagePart& part, std::string_view joint) {
    if (!part.shape->in_plane() || !turns(part, joint)) return false;
    const ik::Link& link = part.linkage().links[*part.linkage().find_link(joint)];
    return !std::isfinite(link.minimum) && !std::isfinite(link.maximum);
}

}  // namespace

bool turns(const LinkagePart& part, std::string_view joint) {
    const auto link = part.linkage().find_link(joint);
    return link && part.linkage().links[*link].joint == ik::LinkJoint::Hinge;
}

double in_degrees(const LinkagePart& part, std::string_view joint, double value) {
    return turns(part, joint) ? glm::degrees(value) : value;
}

double from_degrees(const LinkagePart& part, std::string_view joint, double value) {
    return turns(part, joint) ? glm::radians(value) : value;
}

CommandCall motor_call(const LinkagePart& part, const std::string& joint, ArgumentValue speed) {
    return {"linkage.motor",
            {{"joint", joint}, {turns(part, joint) ? "deg_per_s" : "per_s", std::move(speed)}}};
}

ShownValue shown_value(const LinkagePart& part, std::string_view joint, double value) {
    const double degrees = in_degrees(part, joint, value);
    if (!goes_round(part, joint)) return {degrees};
    constexpr double half_a_digit = 0.05;  // 359.96 would read 360.0
    const double whole = std::floor((degrees + half_a_digit) / 360.0);
    return {std::max(degrees - 360.0 * whole, 0.0), static_cast<int>(std::clamp(whole, -1e9, 1e9))};
}

std::string value_text(const LinkagePart& part, std::string_view joint, double value) {
    const double shown = shown_value(part, joint, value).value;
    return turns(part, joint) ? fixed_text(shown, 1) + " degrees" : fixed_text(shown, 3) + " m";
}

double angle_at(const LinkagePart& part, std::string_view point, std::string* name) {
    const ik::LinkageSketch& sketch = part.shape->sketch;
    const auto at = sketch.find_point(point);
    if (!at) return no_angle;
    const std::vector<std::size_t> here = bars_at(sketch, *at);
    if (here.empty()) return no_angle;
    const auto end = [&](std::size_t bar) {
        const std::vector<std::size_t>& points = sketch.bars[bar].points;
        return points[0] == *at ? points[1] : points[0];
    };
    const std::vector<std::size_t>& bodies = part.shape->bodies;
    auto other = std::ranges::find_if(here, [&](auto bar) { return bodies[bar] != bodies[here[0]]; });
    if (other == here.end() && sketch.points[*at].hold != ik::SketchHold::Pinned && here.size() > 1)
        other = here.begin() + 1;
    const bool alone = other == here.end();
    if (name != nullptr) {
        const std::string one = sketch.points[end(here[0])].name, middle = sketch.points[*at].name,
                          two = alone ? "" : sketch.points[end(*other)].name;
        const char* const dash = std::max({one.size(), middle.size(), two.size()}) > 1 ? "-" : "";
        *name = alone ? middle + dash + one + " to X" : one + dash + middle + dash + two;
    }
    return between(way(part, *at, end(here[0])), alone ? glm::dvec2(1.0, 0.0) : way(part, *at, end(*other)));
}

double transmission_angle(const LinkagePart& part) {
    double smallest = no_angle;
    for (const DrivenLoop& each : part.shape->driven)
        smallest = std::fmin(smallest, transmission_in(part, each));
    return smallest;
}

std::optional<WorstTransmission> worst_transmission(const LinkagePart& part, const LinkageTurn& turn) {
    if (part.shape->driven.empty() || turn.poses.empty()) return std::nullopt;
    PartInTurn in_turn(part);
    const std::vector<LinkageTurn::Pose>& poses = turn.poses;
    const std::size_t count = poses.size();
    std::vector<double> angles;
    for (const LinkageTurn::Pose& each : poses) angles.push_back(transmission_angle(*in_turn.at(each)));
    const auto at = static_cast<std::size_t>(std::ranges::min_element(angles) - angles.begin());
    WorstTransmission worst{angles[at], poses[at].value};
    if (count < 3 || (!turn.whole && (at == 0 || at + 1 == count))) return worst;
    // Refine between poses: the minimum of the parabola through three of them.
    const std::size_t before = (at + count - 1) % count, after = (at + 1) % count;
    const auto far = [&](std::size_t from, std::size_t to) {
        const double by = std::abs(poses[to].value - poses[from].value);
        return from < to ? by : 2.0 * std::numbers::pi - by;
    };
    const double down = (angles[before] - worst.degrees) / far(before, at),
                 up = (angles[after] - worst.degrees) / far(at, after);
    const double bend = (down + up) / (far(before, at) + far(at, after));
    if (!(bend > 1e-9)) return worst;
    const double slope = up - bend * far(at, after);
    const double most = std::max(angles[before], angles[after]) - worst.degrees;  // beside a cusp
    worst.degrees = std::max(worst.degrees - std::min(0.25 * slope * slope / bend, most), 0.0);
    worst.value -= 0.5 * slope / bend;
    return worst;
}

double usual_motor_rate(const LinkagePart& part, std::string_view joint, LinkageRuntime& runtime) {
    const LinkageDrive* const drive = part.find_drive(joint);
    if (drive != nullptr && drive->last_rate != 0.0) return drive->last_rate;
    if (turns(part, joint)) return glm::radians(90.0);
    return std::min(0.1 * runtime.solver(part.shape).size(), max_motor_rate);
}

std::vector<LinkageDrive> moving_drives(const LinkagePart& part, LinkageRuntime& runtime) {
    std::vector<LinkageDrive> drives = part.drives;
    if (!drives.empty() && std::ranges::none_of(drives, is_running)) {
        drives.front().rate = usual_motor_rate(part, drives.front().joint, runtime);
        drives.front().held = true;
    }
    std::erase_if(drives, [](const LinkageDrive& each) { return !each.held; });
    return drives;
}

double point_speed(const LinkagePart& part, std::string_view point, LinkageRuntime& runtime) {
    const auto at = part.linkage().find_point(point);
    if (!at || part.linkage().points[*at].link == ik::ground_link || part.drives.empty()) return no_angle;
    ik::LinkageSolver& solver = runtime.solver(part.shape);
    const std::vector<LinkageDrive> drives = moving_drives(part, runtime);
    double quickest = 0.0;  // radians or sizes of the linkage per second
    for (const LinkageDrive& each : drives)
        quickest = std::max(quickest, std::abs(each.rate) / (turns(part, each.joint) ? 1.0 : solver.size()));
    if (!(quickest > 0.0)) return no_angle;
    constexpr double small_turn = 1e-3;  // radians; a motor reaches its value within 1e-6
    const double seconds = small_turn / quickest;
    std::vector<glm::dvec3> ends;  // one joint is at the end of a range
    for (const double by : {-seconds, seconds}) {
        std::vector<ik::LinkDriver> drivers;
        for (const LinkageDrive& each : drives)
            drivers.push_back(
                {*part.linkage().find_link(each.joint), part.value_of(each.joint) + by * each.rate});
        ik::LinkageState state = part.state;
        const ik::LinkageStatus status = solver.solve(state, {drivers, {}}).status;
        if (status == ik::LinkageStatus::Reached)
            ends.push_back(solver.point(*at));
        else if (status != ik::LinkageStatus::Limited)
            return no_angle;
    }
    if (ends.empty()) return no_angle;
    if (ends.size() == 1) return glm::distance(ends[0], part.at(*at)) / seconds;
    return glm::distance(ends[0], ends[1]) / (2.0 * seconds);
}

std::string speed_text(const LinkagePart& part, double speed, LinkageRuntime& runtime) {
    return runtime.solver(part.shape).size() < 1.0 ? fixed_text(1000.0 * speed, 1) + " mm/s"
                                                   : fixed_text(speed, 2) + " m/s";
}

std::string point_speed_text(const LinkagePart& part, std::string_view point, LinkageRuntime& runtime) {
    const double speed = point_speed(part, point, runtime);
    if (!std::isfinite(speed)) return {};
    const std::string text = speed_text(part, speed, runtime);
    if (std::ranges::any_of(part.drives, is_running)) return text;
    const std::string& joint = part.drives.front().joint;
    const double rate = std::abs(in_degrees(part, joint, usual_motor_rate(part, joint, runtime)));
    return text + " at " + fixed_text(rate, turns(part, joint) ? 0 : 2) +
           (turns(part, joint) ? " deg/s" : " m/s");
}

ik::LinkageFreedom freedom_of(const LinkagePart& part) {
    const ik::LinkageFreedom &held = part.result.freedom, &loose = part.shape->loose;
    return {held.counted + loose.counted, held.actual + loose.actual};
}

namespace {

/// The joint forces between a linkage's bodies that balance its motor's torque.
class BalancedBodies {
  public:
    BalancedBodies(const LinkagePart& part, std::size_t driver, ik::LinkageSolver& solver)
        : sketch_(part.shape->sketch),
          linkage_(part.linkage()),
          rigid_(ik::rigid_bodies(sketch_)),
          body_(linkage_.links.size()),
          forces_(linkage_.closures.size()) {
        for (std::size_t i = 0; i < body_.size(); ++i) body_[i] = rigid_.size() + i;  // a guided point's link
        for (std::size_t bar = 0; bar < rigid_.size(); ++bar)
            if (const auto link = link_of_bar(linkage_, sketch_, bar)) body_[*link] = rigid_[bar];
        std::vector<std::size_t> held;
        for (const LinkageDrive& each : part.drives)
            if (each.held) held.push_back(*linkage_.find_link(each.joint));
        loose_ = solver.balance(part.state, driver, held, forces_);
        add_up();
        turned_ = {body_of(driver), body_of(linkage_.links[driver].parent), ik::ground_link};
    }
    /// The unbalanced part of the motor's torque; 1 if a joint is not in the sketch.
    double loose() const { return loose_; }

    /// Two bars with two joints each that balance, hence are in line; or one that is square to a guide.
    std::optional<DeadPoint> bars_in_line() const {
        for (const auto& [body, points] : at_)
            for (const auto& [joint, force] : points) {
                const auto end = other_end(body, joint);
                const auto other = only_other(body, joint);
                if (!end || !other) continue;
                if (sketch_.points[joint].hold == ik::SketchHold::Guided)
                    return DeadPoint{{{*end, joint}},
                                     "the line from " + name(*end) + " to " + name(joint) +
                                         " is square to the guide of " + name(joint)};
                const auto next = other_end(*other, joint);
                if (next && body < *other)
                    return DeadPoint{
                        {{*end, joint}, {joint, *next}},
                        name(*end) + ", " + name(joint) + " and " + name(*next) + " are in line"};
            }
        return std::nullopt;
    }
    /// Finds a body on which three forces balance, so their lines meet.
    std::optional<DeadPoint> forces_that_meet() const {
        for (const auto& [body, points] : at_) {
            if (points.size() != 3 || is_turned(body)) continue;
            DeadPoint found;
            std::vector<std::string> lines;
            std::vector<glm::dvec2> ways;
            for (const auto& [joint, force] : points) {
                const auto other = only_other(body, joint);
                const auto end = other ? other_end(*other, joint) : std::nullopt;
                lines.push_back(end ? name(joint) + "-" + name(*end) : "of the force on " + name(joint));
                if (end) found.lines.push_back({joint, *end});
                ways.push_back(force / glm::length(force));
            }
            const auto apart = [&](std::size_t a, std::size_t b) {
                return std::abs(ways[a].x * ways[b].y - ways[a].y * ways[b].x);
            };
            constexpr double parallel = 0.01;  // sine of an angle: the lines meet 100 bar lengths away
            const bool meet = std::max(apart(0, 1), apart(0, 2)) > parallel;
            found.text = "the lines " + lines[0] + ", " + lines[1] + " and " + lines[2] +
                         (meet ? " meet in one point" : " are parallel");
            return found;
        }
        return std::nullopt;
    }

  private:
    using Forces = std::map<std::size_t, glm::dvec2>;  ///< keyed by point of the sketch

    std::size_t body_of(std::size_t link) const { return link == ik::ground_link ? link : body_[link]; }
    const std::string& name(std::size_t point) const { return sketch_.points[point].name; }
    /// The sketch's point drawn at this position, preferably the one with that name.
    std::optional<std::size_t> point_at(const glm::dvec3& drawn, const std::string& called) const {
        std::optional<std::size_t> found;
        for (std::size_t i = sketch_.points.size(); i-- > 0;)
            if (sketch_.points[i].at == glm::dvec2(drawn)) {
                found = i;
                if (sketch_.points[i].name == called) break;
            }
        return found;
    }
    void add_up() {
        std::vector<glm::dvec2> on_link(body_.size(), glm::dvec2(0.0));
        const auto exert = [&](std::size_t link, std::optional<std::size_t> point, const glm::dvec2& force) {
            if (point)
                at_[body_of(link)].try_emplace(*point, glm::dvec2(0.0)).first->second += force;
            else
                loose_ = 1.0;
            if (link != ik::ground_link) on_link[link] += force;
        };
        for (std::size_t i = 0; i < forces_.size(); ++i) {
            const ik::Closure& closure = linkage_.closures[i];
            const auto point = point_at(closure.first_at, closure.name);
            exert(closure.first, point, glm::dvec2(forces_[i]));
            exert(closure.second, point, -glm::dvec2(forces_[i]));
        }
        for (std::size_t i = body_.size(); i-- > 0;) {
            const glm::dvec2 passed_on = on_link[i];
            const auto point = point_at(linkage_.links[i].at, linkage_.links[i].name);
            exert(i, point, -passed_on);
            exert(linkage_.links[i].parent, point, passed_on);
        }
        double largest = 0.0;
        for (const auto& [body, points] : at_)
            for (const auto& [point, force] : points) largest = std::max(largest, glm::length(force));
        // Near a dead point, other loops carry a share of the unbalanced torque.
        constexpr double none = 0.01;  // relative to the largest force: turns its line by 0.6 degrees
        const double minimum = std::max(none, 3.0 * loose_) * largest;
        for (auto& [body, points] : at_)
            std::erase_if(points, [&](const auto& each) { return glm::length(each.second) <= minimum; });
    }
    bool is_turned(std::size_t body) const { return std::ranges::find(turned_, body) != turned_.end(); }
    /// The other joint of a body with two joints.
    std::optional<std::size_t> other_end(std::size_t body, std::size_t joint) const {
        const auto found = at_.find(body);
        if (found == at_.end() || found->second.size() != 2 || is_turned(body)) return std::nullopt;
        const std::size_t first = found->second.begin()->first;
        return first == joint ? found->second.rbegin()->first : first;
    }
    /// The other body at the joint, if there is exactly one.
    std::optional<std::size_t> only_other(std::size_t body, std::size_t joint) const {
        std::optional<std::size_t> other;
        for (const auto& [each, points] : at_) {
            if (each == body || !points.contains(joint)) continue;
            if (other) return std::nullopt;
            other = each;
        }
        return other;
    }

    const ik::LinkageSketch& sketch_;
    const ik::Linkage& linkage_;
    std::vector<std::size_t> rigid_, body_;  ///< per bar; per link
    std::vector<glm::dvec3> forces_;
    double loose_ = 1.0;
    std::map<std::size_t, Forces> at_;     ///< by body
    std::array<std::size_t, 3> turned_{};  ///< also under a torque: the motor's two, and the ground
};

}  // namespace

std::optional<DeadPoint> dead_point(const LinkagePart& part, LinkageRuntime& runtime, double within) {
    if (part.shape->sketch.points.empty()) return std::nullopt;
    std::optional<std::size_t> driver = part.result.report.stopped;
    if (!driver && !part.drives.empty()) driver = part.linkage().find_link(part.drives.front().joint);
    if (!driver) return std::nullopt;
    const BalancedBodies bodies(part, *driver, runtime.solver(part.shape));
    if (bodies.loose() > math::sine(glm::radians(within))) return std::nullopt;
    if (auto found = bodies.bars_in_line()) return found;
    return bodies.forces_that_meet();
}

std::string dead_point_reason(const LinkagePart& part, LinkageRuntime& runtime, double within) {
    const auto found = dead_point(part, runtime, within);
    return found ? found->text : std::string();
}

std::string stop_text(const LinkagePart& part) {
    const ik::LinkageReport& report = part.result.report;
    if (!report.stopped) return "The drivers";
    const std::string& joint = part.linkage().links[*report.stopped].name;
    return capitalised(joint) + " at " + value_text(part, joint, report.stopped_at);
}

std::string four_bar_kind(const LinkagePart& part) {
    const auto bars = four_bar_lengths(part);
    if (!bars) return {};
    std::array<double, 4> sorted{bars->ground, bars->crank, bars->coupler, bars->rocker};
    std::ranges::sort(sorted);
    const double shortest = sorted[0], spare = sorted[1] + sorted[2] - sorted[0] - sorted[3];
    if (std::abs(spare) < 1e-9 * sorted[3]) return "change point";
    if (spare < 0.0) return "triple rocker";
    return shortest == bars->ground   ? "drag link"
           : shortest == bars->crank  ? "crank-rocker"
           : shortest == bars->rocker ? "rocker-crank"
                                      : "double rocker";
}

std::vector<Cure> ways_on(const LinkagePart& part, LinkageRuntime& runtime) {
    std::vector<Cure> ways;
    const ik::LinkageReport& report = part.result.report;
    if (report.status != ik::LinkageStatus::DeadPoint || !report.stopped) return ways;
    const std::string& joint = part.linkage().links[*report.stopped].name;
    const LinkageDrive* const drive = part.find_drive(joint);
    if (drive == nullptr) return ways;
    if (drive->rate != 0.0) {
        const CommandCall back = motor_call(part, joint, in_degrees(part, joint, -drive->rate));
        ways.push_back({"Turn back",
                        "Reverses the motor: the linkage returns the way it came",
                        {back},
                        "Back the way it came"});
        ways.push_back(
            {"Other mode",
             "Reverses the motor in the other assembly mode: the linkage continues through the dead point",
             {{"linkage.other_mode", {{"nearest", true}}}, back},
             "Through the dead point"});
    }
    const std::vector<ik::SketchMotor>& motors = part.shape->sketch.motors;
    const auto motor = std::ranges::find(motors, joint, &ik::SketchMotor::name);
    if (motor == motors.end()) return ways;
    const auto round = runtime.round_crank(part, static_cast<std::size_t>(motor - motors.begin()));
    if (!round) return ways;
    const std::string &crank = part.shape->sketch.bars[motor->bar].name,
                      length = fixed_text(round->length, 2) + " m";
    std::vector<CommandCall> calls{
        kind_of(part.shape->mechanism) != nullptr
            ? CommandCall{"linkage.set", {{crank, round->length}}}
            : CommandCall{"linkage.length", {{"bar", crank}, {"length", round->length}}}};
    if (round->from) {
        calls.insert(calls.begin(), {"linkage.drive", {{"joint", joint}, {"value", *round->from}}});
        calls.push_back(motor_call(part, joint, in_degrees(part, joint, drive->rate)));
    }
    ways.push_back({"Shorten",
                    "Makes the crank " + length + " long: up to " + fixed_text(round->longest, 2) +
                        " m it turns all round",
                    std::move(calls), "All round: " + crank + " " + length});
    return ways;
}

}  // namespace tendril::app
