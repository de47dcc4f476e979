// Poses of the lab's linkage, and its shape from a sketch or a mechanism.
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "app/document/refused.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/linkage/linkage_part.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {

std::vector<std::size_t> bars_from_ground(const ik::LinkageSketch& sketch) {
    std::vector<std::size_t> away(sketch.bars.size(), ik::ground_link);
    std::vector<bool> held(sketch.points.size());
    for (std::size_t i = 0; i < held.size(); ++i) held[i] = sketch.points[i].hold != ik::SketchHold::Free;
    bool more = true;
    for (std::size_t step = 0; more; ++step) {
        more = false;
        const std::vector<bool> before = held;
        for (std::size_t b = 0; b < away.size(); ++b) {
            const auto& points = sketch.bars[b].points;
            if (away[b] != ik::ground_link ||
                std::ranges::none_of(points, [&](std::size_t each) { return before[each]; }))
                continue;
            away[b] = step;
            for (const std::size_t each : points) held[each] = true;
            more = true;
        }
    }
    return away;
}

std::vector<bool> floating_bars(const ik::LinkageSketch& sketch) {
    std::vector<bool> floats;
    for (const std::size_t away : bars_from_ground(sketch)) floats.push_back(away == ik::ground_link);
    return floats;
}

namespace {

/// The sketch without floating bars.
ik::LinkageSketch held_part(const ik::LinkageSketch& sketch, const std::vector<bool>& floats) {
    ik::LinkageSketch held = sketch;
    for (std::size_t b = floats.size(); b-- > 0;)
        if (floats[b]) require_ok(ik::remove_bar(held, b));
    return held;
}

/// Freedom of the floating bars: each piece, with one point pinned, is a linkage with two degrees less.
ik::LinkageFreedom freedom_of_loose(const ik::LinkageSketch& sketch, const std::vector<bool>& floats) {
    ik::LinkageFreedom all;
    std::vector<bool> left = floats;
    for (std::size_t b = 0; b < left.size(); ++b) {
        if (!left[b]) continue;
        ik::LinkageSketch piece = sketch;
        for (ik::SketchPoint& each : piece.points) each.hold = ik::SketchHold::Free;
        piece.points[piece.bars[b].points.front()].hold = ik::SketchHold::Pinned;
        const std::vector<bool> others = floating_bars(piece);
        auto solver =
            require_value(ik::LinkageSolver::make(require_value(ik::linkage_from(held_part(piece, others)))));
        const ik::LinkageFreedom freedom = solver.freedom(solver.initial_state());
        all.counted += freedom.counted + 2;
        all.actual += freedom.actual + 2;
        for (std::size_t i = b; i < left.size(); ++i) left[i] = left[i] && others[i];
    }
    return all;
}

/// Converts the walker's motor angle to a leg's or, with `back`, the reverse.
double motor_of(const LinkageCopy& copy, double angle, bool back = false) {
    if (back) return (copy.mirrored ? std::numbers::pi - angle : angle) - copy.phase;
    return copy.mirrored ? std::numbers::pi - angle - copy.phase : angle + copy.phase;
}

std::vector<std::string> driven_joints(const LinkageShape& shape) {
    std::vector<std::string> names;
    for (const ik::SketchMotor& motor : shape.sketch.motors)
        if (shape.linkage.find_link(motor.name)) names.push_back(motor.name);
    const MechanismKind* const kind = kind_of(shape.mechanism);
    if (kind == nullptr || *kind->drivers == '\0') return names;
    for (const ik::Link& link : shape.linkage.links)
        if (link.name.starts_with(kind->drivers)) names.push_back(link.name);
    return names;
}

}  // namespace

glm::dvec3 LinkagePart::at(std::size_t point) const {
    const ik::LinkPoint& drawn = linkage().points[point];
    return drawn.link == ik::ground_link ? drawn.at : links[drawn.link].point(drawn.at);
}

glm::dvec3 LinkagePart::at(std::size_t point, const LinkageCopy& copy) const {
    const ik::LinkPoint& drawn = linkage().points[point];
    glm::dvec3 now = drawn.link == ik::ground_link ? drawn.at : copy.links[drawn.link].point(drawn.at);
    if (copy.mirrored) now.x = -now.x;
    now.z += copy.depth;
    return now;
}

double LinkagePart::lowest_foot() const {
    if (copies.empty()) return 0.0;
    const std::size_t foot = *linkage().find_point(kind_of(shape->mechanism)->traced);
    double lowest = at(foot).y;
    for (const LinkageCopy& each : copies) lowest = std::min(lowest, at(foot, each).y);
    return lowest;
}

const LinkageDrive* LinkagePart::find_drive(std::string_view joint) const {
    const auto found = std::ranges::find(drives, joint, &LinkageDrive::joint);
    return found == drives.end() ? nullptr : &*found;
}

ik::LinkageSolver& LinkageRuntime::solver(const std::shared_ptr<const LinkageShape>& shape) {
    if (of_ != shape || !solver_) {
        solver_.emplace(require_value(ik::LinkageSolver::make(shape->linkage)));
        of_ = shape;
    }
    return *solver_;
}

void report_in_pose(LinkagePart& part) {
    LinkagePart solved = part;
    LinkageRuntime runtime;
    solve_linkage(solved, runtime);
    part.result = std::move(solved.result);
    ik::LinkageSolver& solver = runtime.solver(part.shape);
    const auto place = [&](const ik::LinkageState& from, std::vector<ik::LinkPlace>& places) {
        static_cast<void>(solver.place(from));
        places.assign(solver.links().begin(), solver.links().end());
    };
    place(part.state, part.links);
    part.result.freedom = solver.freedom(part.state);
    for (LinkageCopy& each : part.copies) place(each.state, each.links);
}

void solve_linkage(LinkagePart& part, LinkageRuntime& runtime, ik::LinkageOptions options) {
    ik::LinkageSolver& solver = runtime.solver(part.shape);
    const ik::Linkage& linkage = part.linkage();
    std::vector<ik::LinkDriver> drivers;
    std::vector<std::size_t> watched;
    for (const LinkageDrive& each : part.drives) {
        const std::size_t link = *linkage.find_link(each.joint);
        watched.push_back(link);
        if (each.held && !part.drag) drivers.push_back({link, each.value});
    }
    std::vector<ik::LinkTarget> targets;
    const auto aim = [&](const LinkageTarget& each) {
        targets.push_back({*linkage.find_point(each.point), each.to, each.weight, each.exact});
    };
    if (part.drag)
        aim(*part.drag);
    else
        for (const LinkageTarget& each : part.targets) aim(each);
    LinkageResult& result = part.result;
    options.watched = watched;
    result.report = solver.solve(part.state, {drivers, targets}, options);
    result.freedom = solver.freedom(part.state);
    result.active.assign(solver.active().begin(), solver.active().end());
    result.open_closures.assign(solver.open_closures().begin(), solver.open_closures().end());
    // A running motor continues from its present value; held values stay as set.
    for (LinkageDrive& each : part.drives)
        if (!each.held || each.rate != 0.0 || part.drag) each.value = part.value_of(each.joint);
    part.links.assign(solver.links().begin(), solver.links().end());
    for (LinkageCopy& each : part.copies) {
        const std::string& motor = part.shape->sketch.motors.front().name;
        const ik::LinkDriver driver{*linkage.find_link(motor), motor_of(each, part.value_of(motor))};
        const ik::LinkageReport report = solver.solve(each.state, {{&driver, 1}, {}});
        each.links.assign(solver.links().begin(), solver.links().end());
        if (report.status <= result.report.status) continue;
        // The status is the worst leg's, at the angle of the shared motor.
        result.report.status = report.status;
        result.report.stopped = report.stopped;
        result.report.stopped_at = motor_of(each, report.stopped_at, true);
        result.report.closed_to = std::max(result.report.closed_to, report.closed_to);
    }
}

namespace {

void find_loops(LinkageShape& shape) {
    const ik::LinkageSketch& sketch = shape.sketch;
    const auto hold = [&](std::size_t point) { return sketch.points[point].hold; };
    std::map<std::size_t, std::set<std::size_t>> points_of, bodies_at;  // by body; by point
    std::set<std::pair<std::size_t, std::size_t>> joints;
    for (std::size_t bar = 0; bar < sketch.bars.size(); ++bar) {
        if (shape.floating[bar]) continue;
        const std::size_t body = shape.bodies[bar];
        for (const std::size_t point : sketch.bars[bar].points) {
            points_of[body].insert(point);
            bodies_at[point].insert(body);
            joints.insert({point, body});
            if (hold(point) != ik::SketchHold::Free) joints.insert({point, ik::ground_link});
        }
    }
    shape.loops = joints.size() + points_of.count(ik::ground_link) - points_of.size() - bodies_at.size();
    for (std::size_t motor = 0; motor < sketch.motors.size(); ++motor) {
        const std::size_t at = sketch.motors[motor].point, crank = shape.bodies[sketch.motors[motor].bar];
        if (sketch.motors[motor].against != ik::ground_link) continue;
        const auto each_joint = [&](std::size_t body, std::size_t from, auto visit) {
            for (const std::size_t point : points_of[body])
                for (const std::size_t next : bodies_at[point])
                    if (point != from && next != body && next != crank && next != ik::ground_link)
                        visit(point, next);
        };
        each_joint(crank, at, [&](std::size_t tip, std::size_t coupler) {
            for (const std::size_t end : points_of[coupler])
                if (end != tip && hold(end) == ik::SketchHold::Guided)
                    shape.driven.push_back({motor, tip, end});
            each_joint(coupler, tip, [&](std::size_t end, std::size_t rocker) {
                for (const std::size_t pin : points_of[rocker])
                    if (pin != at && hold(pin) == ik::SketchHold::Pinned)
                        shape.driven.push_back({motor, tip, end, pin});
            });
        });
    }
}

}  // namespace

LinkageShape shape_of(ik::LinkageSketch sketch) {
    for (const ik::SketchBar& each : sketch.bars)
        if (each.points.size() < 2)
            throw std::invalid_argument("bar \"" + each.name + "\" must have two points");
    LinkageShape shape;
    shape.floating = floating_bars(sketch);
    shape.bodies = ik::rigid_bodies(sketch);
    shape.linkage = require_value(ik::linkage_from(held_part(sketch, shape.floating)));
    shape.loose = freedom_of_loose(sketch, shape.floating);
    shape.sketch = std::move(sketch);
    find_loops(shape);
    return shape;
}

namespace {

/// Builds each mechanism with the library.
struct MakeShape {
    static LinkageShape drawn(Expected<ik::LinkageSketch> sketch) {
        return shape_of(require_value(std::move(sketch)));
    }
    static LinkageShape in_space(Expected<ik::Linkage> linkage) {
        return {.linkage = require_value(std::move(linkage))};
    }

    LinkageShape operator()(const std::monostate&) const { return {}; }
    LinkageShape operator()(const ik::FourBar& lengths) const { return drawn(ik::four_bar(lengths)); }
    LinkageShape operator()(const ik::SliderCrank& lengths) const { return drawn(ik::slider_crank(lengths)); }
    LinkageShape operator()(const ik::Peaucellier& lengths) const { return drawn(ik::peaucellier(lengths)); }
    LinkageShape operator()(const ik::Pantograph& lengths) const { return drawn(ik::pantograph(lengths)); }
    LinkageShape operator()(const ik::ScissorLift& lengths) const { return drawn(ik::scissor_lift(lengths)); }
    LinkageShape operator()(const ik::Jansen& lengths) const { return drawn(ik::jansen(lengths)); }
    LinkageShape operator()(const JansenWalker& lengths) const { return drawn(ik::jansen(lengths)); }
    LinkageShape operator()(const ik::Delta& lengths) const { return in_space(ik::delta(lengths)); }
    LinkageShape operator()(const ik::Stewart& lengths) const { return in_space(ik::stewart(lengths)); }
};

}  // namespace

LinkageShape shape_of(const Mechanism& mechanism) {
    LinkageShape shape = std::visit(MakeShape{}, mechanism);
    shape.mechanism = mechanism;
    return shape;
}

std::vector<LinkageCopy> copies_of(const LinkageShape& shape, const ik::LinkageState& state) {
    std::vector<LinkageCopy> copies;
    const auto* const walker = std::get_if<JansenWalker>(&shape.mechanism);
    if (walker == nullptr) return copies;
    constexpr int pairs = 6;
    constexpr double turn = 2.0 * std::numbers::pi;
    const std::size_t motor = *shape.linkage.find_link(driven_joints(shape).front());
    for (int i = 1; i < 2 * pairs; ++i) {  // the first leg is the linkage itself
        const int pair = i / 2;
        LinkageCopy& copy = copies.emplace_back(LinkageCopy{.phase = pair * turn / pairs,
                                                            .mirrored = i % 2 == 1,
                                                            .depth = -walker->m * pair,
                                                            .state = state});
        // Adds whole turns, which do not change the pose.
        double& value = copy.state.joints[motor].value;
        value += turn * std::round((motor_of(copy, value) - value) / turn);
    }
    return copies;
}

std::optional<std::size_t> link_of_bar(const ik::Linkage& linkage, const ik::LinkageSketch& sketch,
                                       std::size_t bar) {
    for (const ik::SketchMotor& motor : sketch.motors) {
        const auto link = linkage.find_link(motor.name);
        if (!link) continue;
        // If a motor turns two bars against each other, a reversed axis means that `against` is the child.
        const bool turned_round = motor.against != ik::ground_link && linkage.links[*link].axis.z < 0.0;
        if (bar == (turned_round ? motor.against : motor.bar)) return link;
    }
    return linkage.find_link(sketch.bars[bar].name);
}

static constexpr double whole_turn = 2.0 * std::numbers::pi;

double turned_near(double value, double other, const ik::Link& link) {
    value += whole_turn * std::round((other - value) / whole_turn);
    if (value > link.maximum) value -= whole_turn * std::ceil((value - link.maximum) / whole_turn);
    if (value < link.minimum) value += whole_turn * std::ceil((link.minimum - value) / whole_turn);
    return value;
}

namespace {

bool is_hinge(const ik::Link& link) {
    return link.joint == ik::LinkJoint::Hinge;
}

/// The angle of a bar's direction, from its first joint to its second.
double bar_direction(const ik::SketchBar& bar, auto at) {
    const glm::dvec2 way = glm::dvec2(at(bar.points[1])) - glm::dvec2(at(bar.points[0]));
    return math::arctangent(way.y, way.x);
}

/// The angle from a bar as drawn in the new shape to the same bar in the old part's pose. None if the old
/// part lacks it.
std::optional<double> turn_of_bar(const LinkagePart& old, const ik::LinkageSketch& sketch, std::size_t bar) {
    const ik::LinkageSketch& was = old.shape->sketch;
    const auto same = was.find_bar(sketch.bars[bar].name);
    if (!same) return std::nullopt;
    return bar_direction(was.bars[*same], [&](std::size_t i) { return old.at(i); }) -
           bar_direction(sketch.bars[bar], [&](std::size_t i) { return sketch.points[i].at; });
}

/// Uses the pose of another part of the same mechanism: in the plane its bars keep their directions, in space
/// its joints keep their values. Solving then closes the loops.
void pose_like(const LinkagePart& old, const LinkageShape& shape, ik::LinkageState& state) {
    std::vector<double> turns(shape.linkage.links.size());
    const auto turn_of = [&](std::size_t link) { return link == ik::ground_link ? 0.0 : turns[link]; };
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const ik::Link& link = shape.linkage.links[i];
        ik::JointPlace& place = state.joints[i];
        const auto before = old.linkage().find_link(link.name);
        if (before) {
            const double drawn = place.value;
            place = old.state.joints[*before];
            if (is_hinge(link) && !shape.in_plane())
                place.value = turned_near(place.value, place.value, link);
            if (is_hinge(link) && shape.in_plane()) place.value = drawn;
        }
        turns[i] = turn_of(link.parent);
        if (!shape.in_plane() || !is_hinge(link)) continue;
        for (std::size_t bar = 0; bar < shape.sketch.bars.size(); ++bar) {
            if (link_of_bar(shape.linkage, shape.sketch, bar) != i) continue;
            const std::optional<double> turn = turn_of_bar(old, shape.sketch, bar);
            if (!turn) continue;
            turns[i] = *turn;
            const double value =
                link.rest + (link.axis.z < 0.0 ? -1.0 : 1.0) * (*turn - turn_of(link.parent));
            const double near = before ? old.state.joints[*before].value : link.rest;
            place.value = turned_near(value, near, link);
        }
    }
}

}  // namespace

void set_ranges(LinkageShape& shape, std::vector<LinkageRange> ranges) {
    std::erase_if(ranges, [&](const LinkageRange& each) {
        const auto link = shape.linkage.find_link(each.joint);
        return !link || shape.linkage.links[*link].joint == ik::LinkJoint::Ball;
    });
    for (const LinkageRange& each : ranges) {
        ik::Link& link = shape.linkage.links[*shape.linkage.find_link(each.joint)];
        link.minimum = each.minimum;
        link.maximum = each.maximum;
        if (is_hinge(link)) link.rest = turned_near(link.rest, link.rest, link);
        if (link.rest >= link.minimum && link.rest <= link.maximum) continue;
        const auto text = [&](double value) {
            return is_hinge(link) ? fixed_text(glm::degrees(value), 1) + " degrees"
                                  : fixed_text(value, 3) + " m";
        };
        throw std::invalid_argument("the range of \"" + each.joint + "\" must hold " + text(link.rest) +
                                    ", where it is drawn, got " + text(each.minimum) + " to " +
                                    text(each.maximum));
    }
    shape.ranges = std::move(ranges);
}

void take_shape(LinkagePart& part, LinkageShape shape, LinkageRuntime& runtime) {
    take_shape(part, std::move(shape), part.shape->ranges, runtime);
}

void take_shape(LinkagePart& part, LinkageShape shape, std::vector<LinkageRange> ranges,
                LinkageRuntime& runtime) {
    set_ranges(shape, std::move(ranges));
    const bool same_kind =
        kind_of(shape.mechanism) != nullptr && shape.mechanism.index() == part.shape->mechanism.index();
    const auto made = std::make_shared<const LinkageShape>(std::move(shape));
    ik::LinkageState state = runtime.solver(made).initial_state();
    const std::vector<std::string> were_driven = driven_joints(*part.shape);  // a drive ends with its motor
    if (same_kind) pose_like(part, *made, state);
    part.shape = made;
    part.state = std::move(state);
    part.copies = copies_of(*part.shape, part.state);
    part.walked = 0.0;
    std::vector<std::string> driven = driven_joints(*part.shape);
    for (const LinkageDrive& each : part.drives) {
        const auto link = part.linkage().find_link(each.joint);
        const bool stays = link && part.linkage().links[*link].joint != ik::LinkJoint::Ball &&
                           std::ranges::count(were_driven, each.joint) == 0;
        if (stays && std::ranges::count(driven, each.joint) == 0) driven.push_back(each.joint);
    }
    std::vector<LinkageDrive> drives;
    for (const std::string& joint : driven) {
        const LinkageDrive* const before = part.find_drive(joint);
        LinkageDrive& drive = drives.emplace_back(before != nullptr ? *before : LinkageDrive{.joint = joint});
        const std::size_t link = *part.linkage().find_link(joint);
        const double drawn = part.state.joints[link].value, held = drive.value;
        const bool hinge = is_hinge(part.linkage().links[link]);
        const bool counted = same_kind && before != nullptr;  // it keeps counting its turns
        drive.value = !drive.held         ? drawn
                      : hinge && !counted ? drawn + std::remainder(held - drawn, whole_turn)
                                          : held;
    }
    part.drives = std::move(drives);
    const auto gone = [&](const std::string& point) { return !part.linkage().find_point(point); };
    std::erase_if(part.targets, [&](const LinkageTarget& each) { return gone(each.point); });
    if (gone(part.selected)) part.selected.clear();
    part.drag.reset();
    solve_linkage(part, runtime);
}

ik::LinkageSketch present_sketch(const LinkagePart& part) {
    if (!part.shape->in_plane()) throw Refused("only linkages in a plane can be drawn by hand");
    ik::LinkageSketch sketch = part.shape->sketch;
    for (std::size_t i = 0; i < sketch.points.size(); ++i) sketch.points[i].at = glm::dvec2(part.at(i));
    return sketch;
}

LinkagePart first_linkage() {
    LinkagePart part;
    LinkageRuntime runtime;
    open_mechanism(part, ik::FourBar{}, runtime);
    return part;
}

void open_mechanism(LinkagePart& part, const Mechanism& mechanism, LinkageRuntime& runtime) {
    const LinkageTool tool = part.tool;
    LinkageShape shape = shape_of(mechanism);
    part = {};
    part.tool = tool;
    const MechanismKind* const kind = kind_of(mechanism);
    part.selected = kind != nullptr ? kind->traced : "";
    take_shape(part, std::move(shape), runtime);
}

}  // namespace tendril::app
