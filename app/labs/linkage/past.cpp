
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "app/io/text.hpp"
#include "app/labs/linkage/draw.hpp"
#include "app/labs/linkage/measures.hpp"

namespace tendril::app {
namespace {

/// A motor's value; an angle continues from the turn in which the plot begins.
PastCurve motor_curve(const Workspace& workspace) {
    const LinkagePart& part = linkage_part(workspace);
    const std::string joint = part.drives.empty() ? "" : part.drives.front().joint;
    const auto shown = [joint](const LinkagePart& then) -> std::optional<ShownValue> {
        if (then.find_drive(joint) == nullptr) return std::nullopt;
        return shown_value(then, joint, then.value_of(joint));
    };
    const Rewind& past = workspace.rewind;
    const auto first = past.empty() ? shown(part) : shown(part_as<LinkagePart>(past.moments().front().part));
    const int turns_before = first ? first->turns : 0;
    return {.name = joint,
            .unit = joint.empty() || turns(part, joint) ? "deg" : "m",
            .lowest_range = 0.01f,
            .missing = "There is no motor: add one.",
            .value =
                [shown, turns_before](const SharedPart& then) {
                    const auto value = shown(part_as<LinkagePart>(then));
                    return value ? value->value + 360.0 * (value->turns - turns_before) : no_value;
                },
            .of = "motor " + joint + " after turn " + std::to_string(turns_before)};
}

PastCurve angle_curve(const Workspace& workspace) {
    const std::string point = linkage_part(workspace).selected;
    return {.name = point.empty() ? "angle at a joint" : "angle at " + point,
            .missing = "Select a joint between two bars.",
            .value = [point](const SharedPart& then) { return angle_at(part_as<LinkagePart>(then), point); }};
}

PastCurve speed_curve(const Workspace& workspace) {
    const std::string point = linkage_part(workspace).selected;
    auto& runtime = workspace.runtimes.of<LinkageRuntime>(linkage_lab);
    return {.name = point.empty() ? "speed of a joint" : "speed of " + point,
            .unit = "m/s",
            .lowest_range = 0.1f,
            .missing = "Select a joint that a motor moves.",
            .value = [point, &runtime](const SharedPart& then) {
                return point_speed(part_as<LinkagePart>(then), point, runtime);
            }};
}

PastCurve transmission_curve(const Workspace&) {
    return {.name = transmission_name,
            .missing = "A motor has to drive a coupler.",
            .value = [](const SharedPart& then) { return transmission_angle(part_as<LinkagePart>(then)); }};
}

PoseLines lines_of(const Workspace&, const SharedPart& shared) {
    const auto& part = part_as<LinkagePart>(shared);
    PoseLines lines;
    const auto add = [&](const std::vector<glm::vec3>& places) {
        for (std::size_t i = 1; i < places.size(); ++i) lines.emplace_back(places[i - 1], places[i]);
    };
    if (!part.shape->in_plane())
        for (std::size_t i = 0; i < part.linkage().links.size(); ++i) add(places_on(part, i));
    for (const ik::SketchBar& bar : part.shape->sketch.bars) {
        std::vector<glm::vec3> places;
        for (const std::size_t each : bar.points) places.push_back(in_scene(part, part.at(each)));
        add(places);
    }
    return lines;
}

bool same_joints(const Part& then, const Part& now) {
    return part_as<LinkagePart>(then).shape == part_as<LinkagePart>(now).shape;
}

}  // namespace

std::vector<Curve> linkage_turn_curves(const Workspace& workspace, const PastCurve& curve) {
    std::vector<Curve> pieces;
    const LinkagePart& part = linkage_part(workspace);
    const LinkageTurn& turn = workspace.runtimes.of<LinkageRuntime>(linkage_lab).turn(part);
    if (turn.poses.size() < 2 || curve.of == motor_curve(workspace).of) return pieces;
    const std::string& joint = part.linkage().links[turn.joint].name;
    const auto begin_piece = [&] {
        pieces.push_back({.name = curve.name,
                          .colour = palette(workspace.settings.theme).accent,
                          .points = {},
                          .marks = false});
    };
    PartInTurn in_turn(part);
    std::optional<glm::vec2> last;
    const auto add = [&](const LinkageTurn::Pose& pose) {
        const auto value = static_cast<float>(curve.value(in_turn.at(pose)));
        const glm::vec2 next(shown_value(part, joint, pose.value).value, value);
        if (!std::isfinite(value)) return;
        if (!last) begin_piece();
        if (last && next.x < last->x) {  // passed 360 degrees and starts again at 0
            const float middle = 0.5f * (last->y + value);
            pieces.back().points.emplace_back(360.0f, middle);
            begin_piece();
            pieces.back().points.emplace_back(0.0f, middle);
        }
        pieces.back().points.push_back(next);
        last = next;
    };
    for (const LinkageTurn::Pose& each : turn.poses) add(each);
    if (turn.whole) add(turn.poses.front());
    return pieces;
}

namespace {

const LinkageTarget* target_of(const LinkagePart& part, const std::string& point) {
    if (part.drag) return part.drag->point == point ? &*part.drag : nullptr;
    const auto found = std::ranges::find(part.targets, point, &LinkageTarget::point);
    return found == part.targets.end() ? nullptr : &*found;
}

/// The incident if a point moved much further than the target that it follows.
std::optional<Incident> jump_incident(const LinkagePart& before, const LinkagePart& after) {
    constexpr double further = 3.0;
    const ik::LinkageReport& report = after.result.report;
    const LinkageTarget* const is = jumped_target(after);
    const LinkageTarget* const was = is == nullptr ? nullptr : target_of(before, is->point);
    if (was == nullptr) return std::nullopt;
    const double asked = glm::distance(was->to, is->to);
    if (report.jump <= further * asked) return std::nullopt;
    return Incident{.kind = Incident::Kind::Jump,
                    .joint = 0,
                    .name = is->point,
                    .cause = is->point + " jumped " + app::length_text(report.jump) +
                             ": its old position is no longer the nearest to its target, which moved " +
                             app::length_text(asked)};
}

}  // namespace

const LinkageTarget* jumped_target(const LinkagePart& part) {
    const std::optional<std::size_t> index = part.result.report.jumped;
    if (!index) return nullptr;
    if (part.drag) return &*part.drag;
    return *index < part.targets.size() ? &part.targets[*index] : nullptr;
}

namespace {

/// Dead points, ends of ranges, points that jumped, and bars that do not meet, between two ticks.
std::vector<Incident> incidents_of(const Workspace& workspace, const Part& first, const Part& second) {
    using enum ik::LinkageStatus;
    const auto &before = part_as<LinkagePart>(first), &after = part_as<LinkagePart>(second);
    auto& runtime = workspace.runtimes.of<LinkageRuntime>(linkage_lab);
    if (before.shape != after.shape) return {};
    const ik::LinkageReport &was = before.result.report, &is = after.result.report;
    std::vector<Incident> incidents;
    const bool moved = before.state != after.state;  // otherwise it is the same solve
    if (moved)
        if (auto jump = jump_incident(before, after)) incidents.push_back(std::move(*jump));
    if (moved && is.passed_dead_point) {
        constexpr double about_in_line = 20.0;  // degrees; wide, since it is seen a tick later
        const std::string line = dead_point_reason(after, runtime, about_in_line);
        incidents.push_back({.kind = Incident::Kind::Limit,
                             .joint = 0,
                             .name = after.drives.empty() ? "linkage" : after.drives.front().joint,
                             .cause = "passed a dead point: " + (line.empty() ? "" : line + "; ") +
                                      "the linkage switched to its other assembly mode",
                             .buttons = {{"Other mode",
                                          "Runs linkage.other_mode: returns to the previous mode",
                                          {{"linkage.other_mode", {{"nearest", true}}}}}}});
    }
    if (is.stopped && is.stopped != was.stopped) {
        const std::string& joint = after.linkage().links[*is.stopped].name;
        const bool dead = is.status == DeadPoint;
        const std::string reason = dead ? dead_point_reason(after, runtime) : std::string();
        incidents.push_back(
            {.kind = Incident::Kind::Limit,
             .joint = *is.stopped,
             .name = joint,
             .degrees = turns(after, joint) ? static_cast<float>(glm::degrees(is.stopped_at)) : 0.0f,
             .cause = joint + (dead ? " is at a dead point: " : " is stopped by a range: ") +
                      "it cannot move past " + value_text(after, joint, is.stopped_at) +
                      (reason.empty() ? "" : ", for " + reason),
             .buttons = ways_on(after, runtime)});
    } else if (is.status == Open && was.status != Open) {
        incidents.push_back({.kind = Incident::Kind::Status,
                             .joint = 0,
                             .cause = "no pose was found that closes it: the bars are " +
                                      app::length_text(is.closed_to) + " apart"});
    }
    return incidents;
}

}  // namespace

const Past& linkage_past() {
    static const Past past{.lab = linkage_lab,
                           .what = "linkage",
                           .probes = {{"angle", "angle at a joint", angle_curve},
                                      {"speed", "speed of a joint", speed_curve},
                                      {"transmission", transmission_name, transmission_curve},
                                      {"motor", "first motor", motor_curve}},
                           .plot_help =
                               "Plotted below the scene for the last ten seconds: the angle at the selected "
                               "joint, its speed, how well the coupler pushes, or the motor",
                           .ghosts_help = "Shows the bars at every half second",
                           .pose = lines_of,
                           .same_joints = same_joints,
                           .incidents = incidents_of};
    return past;
}

}  // namespace tendril::app
