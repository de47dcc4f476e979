#include "app/labs/linkage/past.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "app/document/units.hpp"
#include "app/labs/linkage/draw.hpp"
#include "app/labs/linkage/linkage_commands.hpp"

namespace tendril::app {
namespace {

enum class LinkageNumber { Angle, Transmission, Motor };  // in the order of linkage_past()

const LinkagePart& linkage_of(const SharedPart& part) {
    return dynamic_cast<const LinkagePart&>(*part);
}

double shown_value(const LinkagePart& part, const LinkageDrive& drive) {
    const double value = part.value_of(drive.joint);
    return turns(part, drive.joint) ? glm::degrees(value) : value;
}

}  // namespace

PastView linkage_past() {
    return past_view(
        linkage_lab, "linkage",
        {{"angle", "angle at a joint"}, {"transmission", "transmission angle"}, {"motor", "first motor"}},
        [](const Part& then, const Part& now) {
            return dynamic_cast<const LinkagePart&>(then).shape ==
                   dynamic_cast<const LinkagePart&>(now).shape;
        });
}

std::optional<PastCurve> linkage_past_curve(const Workspace& workspace) {
    const PastView view = linkage_past();
    if (!view.plots(workspace.settings)) return std::nullopt;
    const LinkagePart& part = linkage_part(workspace);
    switch (static_cast<LinkageNumber>(view.chosen(workspace.settings))) {
        case LinkageNumber::Angle: {
            const std::string point = part.selected;
            return PastCurve{
                .name = point.empty() ? "angle at a joint" : "angle at " + point,
                .of = "angle " + point,
                .missing = "Select a joint between two bars.",
                .value = [point](const SharedPart& then) { return angle_at(linkage_of(then), point); }};
        }
        case LinkageNumber::Transmission:
            return PastCurve{
                .name = "transmission angle",
                .of = "transmission",
                .missing = "A motor has to drive a coupler.",
                .value = [](const SharedPart& then) { return transmission_angle(linkage_of(then)); }};
        default:
            break;
    }
    const std::string joint = part.drives.empty() ? "" : part.drives.front().joint;
    return PastCurve{.name = joint,
                     .of = "motor " + joint,
                     .unit = joint.empty() || turns(part, joint) ? "deg" : "m",
                     .lowest_range = 0.01f,
                     .missing = "There is no motor: add one.",
                     .value = [joint](const SharedPart& then) {
                         const LinkageDrive* const drive = linkage_of(then).find_drive(joint);
                         return drive != nullptr ? shown_value(linkage_of(then), *drive)
                                                 : std::numeric_limits<double>::quiet_NaN();
                     }};
}

PoseLines linkage_lines(const SharedPart& shared) {
    const LinkagePart& part = linkage_of(shared);
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

std::vector<std::size_t> joints_in_line(const LinkagePart& part, double within) {
    const ik::LinkageSketch& sketch = part.shape->sketch;
    const auto bars_at = [&](std::size_t point) {
        return std::ranges::count_if(sketch.bars, [&](const ik::SketchBar& each) {
            return std::ranges::count(each.points, point) > 0;
        });
    };
    double best = within;
    std::vector<std::size_t> line;
    for (std::size_t p = 0; p < sketch.points.size(); ++p) {
        if (sketch.points[p].hold == ik::SketchHold::Pinned) continue;
        // Of a bar with more joints, the one that joins it to something else.
        std::vector<std::size_t> ends;
        for (const ik::SketchBar& bar : sketch.bars) {
            if (std::ranges::count(bar.points, p) == 0) continue;
            const auto end = std::ranges::find_if(bar.points, [&](std::size_t other) {
                return other != p &&
                       (sketch.points[other].hold != ik::SketchHold::Free || bars_at(other) > 1);
            });
            if (end != bar.points.end()) ends.push_back(*end);
        }
        if (ends.size() != 2) continue;
        const glm::dvec3 a = part.at(ends[0]) - part.at(p), b = part.at(ends[1]) - part.at(p);
        const double angle =
            glm::degrees(std::atan2(glm::length(glm::cross(a, b)), std::abs(glm::dot(a, b))));
        if (angle >= best) continue;
        best = angle;
        line = {ends[0], p, ends[1]};
    }
    return line;
}

std::string dead_point_reason(const LinkagePart& part, double within) {
    const std::vector<std::size_t> line = joints_in_line(part, within);
    if (line.empty()) return {};
    const auto& points = part.shape->sketch.points;
    return points[line[0]].name + ", " + points[line[1]].name + " and " + points[line[2]].name +
           " are in line";
}

namespace {

const LinkageTarget* target_of(const LinkagePart& part, const std::string& point) {
    if (part.drag) return part.drag->point == point ? &*part.drag : nullptr;
    const auto found = std::ranges::find(part.targets, point, &LinkageTarget::point);
    return found == part.targets.end() ? nullptr : &*found;
}

/// A point that went much further than the target that it follows.
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
                             ": where it was is no longer the place nearest to its target, which moved " +
                             app::length_text(asked)};
}

}  // namespace

const LinkageTarget* jumped_target(const LinkagePart& part) {
    const std::optional<std::size_t> index = part.result.report.jumped;
    if (!index) return nullptr;
    if (part.drag) return &*part.drag;
    return *index < part.targets.size() ? &part.targets[*index] : nullptr;
}

std::vector<Incident> linkage_incidents(const LinkagePart& before, const LinkagePart& after) {
    using enum ik::LinkageStatus;
    if (before.shape != after.shape) return {};
    const ik::LinkageReport &was = before.result.report, &is = after.result.report;
    std::vector<Incident> incidents;
    const std::string reason = dead_point_reason(after);
    const bool moved = before.state != after.state;  // else it is the same solve
    if (moved)
        if (auto jump = jump_incident(before, after)) incidents.push_back(std::move(*jump));
    if (moved && is.passed_dead_point) {
        constexpr double about_in_line = 20.0;  // a tick later
        const std::string line = dead_point_reason(after, about_in_line);
        incidents.push_back({.kind = Incident::Kind::Limit,
                             .joint = 0,
                             .name = after.drives.empty() ? "linkage" : after.drives.front().joint,
                             .cause = "passed a dead point: " + (line.empty() ? "" : line + "; ") +
                                      "the linkage switched to its other assembly mode",
                             .buttons = {{"Other mode",
                                          "Runs linkage.other_mode: back to the mode before",
                                          {{"linkage.other_mode", {}}}}}});
    }
    if (is.stopped && is.stopped != was.stopped) {
        const std::string& joint = after.linkage().links[*is.stopped].name;
        const bool hinge = turns(after, joint), dead = is.status == DeadPoint;
        const std::string at = hinge ? fixed_text(glm::degrees(is.stopped_at), 1) + " degrees"
                                     : fixed_text(is.stopped_at, 3) + " m";
        Incident incident{.kind = Incident::Kind::Limit,
                          .joint = *is.stopped,
                          .name = joint,
                          .degrees = hinge ? static_cast<float>(glm::degrees(is.stopped_at)) : 0.0f,
                          .cause = joint + (dead ? " is at a dead point: " : " is stopped by a range: ") +
                                   "it cannot go on beyond " + at +
                                   (dead && !reason.empty() ? ", for " + reason : "")};
        if (const LinkageDrive* const drive = after.find_drive(joint);
            drive != nullptr && drive->rate != 0.0) {
            const double rate = -drive->rate;
            incident.buttons.push_back(
                {"Turn back",
                 "Runs linkage.motor the other way",
                 {{"linkage.motor",
                   {{"joint", joint}, {hinge ? "deg_per_s" : "per_s", hinge ? glm::degrees(rate) : rate}}}}});
        }
        incidents.push_back(std::move(incident));
    } else if (is.status == Open && was.status != Open) {
        incidents.push_back({.kind = Incident::Kind::Status,
                             .joint = 0,
                             .cause = "no pose was found that closes it: the bars are " +
                                      app::length_text(is.closed_to) + " apart"});
    }
    return incidents;
}

}  // namespace tendril::app
