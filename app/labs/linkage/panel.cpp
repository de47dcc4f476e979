// The Linkage lab's panel and timeline.
#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "app/fields/field_rows.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/linkage/draw.hpp"
#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/linkage/linkage_lab.hpp"
#include "app/labs/linkage/measures.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/plot.hpp"

namespace tendril::app {
namespace {

std::string closure_names(const LinkagePart& part) {
    return comma_list(names(part.result.open_closures,
                            [&](std::size_t each) { return part.linkage().closures[each].name; }));
}

/// "3 degrees of freedom in the plane."
std::string floats_text(const LinkageShape& shape) {
    return count_text(static_cast<std::size_t>(shape.loose.actual), "degree") + " of freedom in the plane.";
}

/// The next step in drawing a linkage by hand. Empty text: nothing is missing.
Verdict drawing_verdict(const LinkagePart& part) {
    const LinkageShape& shape = *part.shape;
    if (shape.sketch.bars.empty())
        return {"Draw a bar", Verdict::Kind::Open,
                part.tool == LinkageTool::Draw
                    ? "Drag from one place to another in the view."
                    : "Choose Draw, and drag from one place to another in the view."};
    const auto loose = std::ranges::count(shape.floating, true);
    if (loose == static_cast<std::ptrdiff_t>(shape.floating.size()))
        return {"Nothing holds it", Verdict::Kind::Open,
                "It floats: " + floats_text(shape) + " Choose Pin, and click the joints that stay in place."};
    if (loose > 0) {
        const auto first = std::ranges::find(shape.floating, true) - shape.floating.begin();
        return {shape.sketch.bars[static_cast<std::size_t>(first)].name + " is loose", Verdict::Kind::Open,
                "It floats: " + floats_text(shape) + " Join it to the others by a bar, or pin a joint."};
    }
    return {};
}

}  // namespace

Verdict linkage_verdict(const LinkagePart& part, LinkageRuntime& runtime, bool playing) {
    using enum ik::LinkageStatus;
    const ik::LinkageReport& report = part.result.report;
    if (part.shape->in_plane())
        if (Verdict next = drawing_verdict(part); !next.text.empty()) return next;
    switch (report.status) {
        case Open:
            return {"Does not close: " + length_text(report.closed_to) + " apart", Verdict::Kind::Bad,
                    "No pose was found with these lengths. Apart: " + closure_names(part) + "."};
        case DeadPoint: {
            const std::string reason = dead_point_reason(part, runtime);
            return {"Dead point", Verdict::Kind::Bad,
                    stop_text(part) + " cannot move further" + (reason.empty() ? "." : ": " + reason + ".")};
        }
        case Limited:
            return {"At the end of a range", Verdict::Kind::Bad,
                    report.stopped ? stop_text(part) + " cannot move further." : "A target is beyond it."};
        case TargetMissed:
            return {"Out of reach: " + length_text(report.residual) + " short", Verdict::Kind::Bad,
                    "No pose was found that brings the point to its target."};
        case IterationLimit:
            return {"Not solved yet", Verdict::Kind::Open,
                    goes_on(part) ? "It continues while the simulation runs."
                                  : "The solver ran out of iterations."};
        case InvalidInput:
            return {"Too large", Verdict::Kind::Bad, "A number is too large to solve."};
        case Reached:
            break;
    }
    const int freedom = part.result.freedom.actual;
    if (freedom == 0)
        return {"Cannot move", Verdict::Kind::Open, "It has no degree of freedom: remove a bar or a pin."};
    const std::string text = count_text(static_cast<std::size_t>(freedom), "degree") + " of freedom";
    if (part.drives.empty())
        return {text, Verdict::Kind::Good, "Drag a joint. Or choose Motor, and click a joint."};
    const auto runs = std::ranges::find_if(part.drives, is_running);
    if (runs == part.drives.end()) return {text, Verdict::Kind::Good, "Drag a joint, or run the motor."};
    std::string runs_on = playing ? "The motor runs" : "Paused";
    if (turns(part, runs->joint)) {
        const std::size_t link = *part.linkage().find_link(runs->joint);
        const double made =
            (part.value_of(runs->joint) - part.linkage().links[link].rest) / (2.0 * std::numbers::pi);
        const auto whole = static_cast<std::size_t>(std::min(std::abs(made) + 1e-9, 1e9));
        if (whole > 0) runs_on += ": " + count_text(whole, "whole turn") + (made < 0.0 ? " backwards" : "");
    }
    return {text, Verdict::Kind::Good, runs_on + (playing ? "." : ". Space continues.")};
}

namespace {

const LinkageDrive* stalled_motor(const LinkagePart& part) {
    const auto found = std::ranges::find_if(
        part.drives, [&](const LinkageDrive& each) { return is_running(each) && is_stalled(part, each); });
    return found != part.drives.end() ? &*found : nullptr;
}

}  // namespace

std::string motor_button(const LinkagePart& part, bool playing) {
    if (const LinkageDrive* const drive = stalled_motor(part))
        return "Stopped at " + value_text(part, drive->joint, part.value_of(drive->joint)) + ": turn back";
    if (std::ranges::none_of(part.drives, is_running)) return "Run";
    return playing ? "Stop" : "Continue";
}

namespace {

void linkage_presets(Emit& emit) {
    std::vector<PresetButton> buttons;
    for (const MechanismKind& kind : mechanism_kinds()) buttons.push_back({kind.name, kind.title, kind.help});
    preset_rows(linkage_lab, buttons, "Removes everything, and starts a drawing", emit, 2);
}

void linkage_tool_rows(const LinkagePart& part, Emit& emit) {
    const auto tools = linkage_tools.values();
    for (const LinkageTool tool : tools)
        if (row_option(linkage_tools.title(tool), static_cast<int>(tools.size()), part.tool == tool,
                       linkage_tools.help(tool)))
            emit("linkage.tool", {{"name", linkage_tools.name(tool)}});
    end_row();
}

/// Speed in degrees or metres per second.
void run_at(const LinkagePart& part, const std::string& joint, ArgumentValue speed, Emit& emit) {
    const CommandCall call = motor_call(part, joint, std::move(speed));
    emit.continuously(call.name, call.arguments);
}

void speed_row(const LinkagePart& part, const LinkageDrive& drive, const std::string& name, Emit& emit) {
    const bool angular = turns(part, drive.joint);
    auto rate = static_cast<float>(in_degrees(part, drive.joint, drive.rate));
    const auto most = static_cast<float>(max_motor_rate);
    if (number_field(name.c_str(), rate, angular ? 1.0f : 0.01f, -most, most,
                     angular ? "%.0f deg/s" : "%.2f m/s"))
        run_at(part, drive.joint, rate, emit);
    explain("The motor's speed while the simulation runs. 0 stops it.");
}

/// A field for a joint's value, in degrees or metres.
bool joint_field(const LinkagePart& part, const std::string& joint, const char* label, float& value) {
    const bool angular = turns(part, joint);
    return number_field(label, value, angular ? 0.5f : 0.002f, -1e6f, 1e6f, angular ? "%.1f deg" : "%.3f m");
}

void value_row(const LinkagePart& part, const LinkageDrive& drive, Emit& emit) {
    const ShownValue now = shown_value(part, drive.joint, part.value_of(drive.joint));
    auto value = static_cast<float>(now.value);
    if (joint_field(part, drive.joint, drive.joint.c_str(), value)) {
        const double wanted = static_cast<double>(value) + 360.0 * now.turns;
        emit.continuously("linkage.drive", {{"joint", drive.joint},
                                            {turns(part, drive.joint) ? "angle_deg" : "value", wanted}});
    }
    explain(now.turns == 0 ? "The joint's value: drag or type it to drive the linkage."
                           : ("The joint's value, in its turn " + std::to_string(now.turns) +
                              ", counted from 0: drag or type it to drive the linkage.")
                                 .c_str());
}

}  // namespace

void linkage_range_rows(const LinkagePart& part, const std::string& joint, Emit& emit) {
    const auto range = std::ranges::find(part.shape->ranges, joint, &LinkageRange::joint);
    if (range == part.shape->ranges.end()) {
        if (row_button(("Limit " + joint).c_str(), 1, true,
                       "Adds a range around the joint's present value")) {
            const double now = in_degrees(part, joint, part.value_of(joint)),
                         about = turns(part, joint) ? 45.0 : 0.5;
            emit("linkage.range", {{"joint", joint}, {"min", now - about}, {"max", now + about}});
        }
        return end_row();
    }
    const auto end = [&](const char* which, double now) {
        if (!std::isfinite(now)) return;
        auto value = static_cast<float>(in_degrees(part, joint, now));
        if (joint_field(part, joint, (joint + " " + which).c_str(), value))
            emit.continuously("linkage.range", {{"joint", joint}, {which, value}});
        explain("An end of the joint's range.");
    };
    end("min", range->minimum);
    end("max", range->maximum);
    if (row_button(("No limit of " + joint).c_str(), 1, true, "Removes the joint's range"))
        emit("linkage.range", {{"joint", joint}, {"off", true}});
    end_row();
}

namespace {

/// Runs, stops and frees all motors.
void motor_buttons(const Workspace& workspace, Emit& emit) {
    const LinkagePart& part = linkage_part(workspace);
    const bool runs = std::ranges::any_of(part.drives, is_running), stands = stalled_motor(part) != nullptr,
               playing = workspace.clock.playing;
    const std::string title = motor_button(part, playing);
    if (row_button(title.c_str(), 1, !part.drives.empty(),
                   "Runs the motor with the simulation, or stops it. If it cannot continue, it turns back")) {
        for (const LinkageDrive& each : part.drives)
            if (stands && is_running(each))
                run_at(part, each.joint, in_degrees(part, each.joint, -each.rate), emit);
            else if (runs && !stands && playing)
                emit.continuously("linkage.drive",
                                  {{"joint", each.joint}, {"value", part.value_of(each.joint)}});
            else if (!runs)
                emit.continuously("linkage.motor", {{"joint", each.joint}});
        if (!playing) emit("time.play");
    }
    if (row_button("Free", 2, std::ranges::any_of(part.drives, &LinkageDrive::held),
                   "Stops the motor, and lets the joint follow the others"))
        for (const LinkageDrive& each : part.drives)
            emit.continuously("linkage.release", {{"joint", each.joint}});
    if (row_button("Other mode", 2, !part.linkage().closures.empty(),
                   "Assembles the same bars in another way, each in turn; the drivers do not move"))
        emit("linkage.other_mode");
    end_row();
}

void driver_rows(const Workspace& workspace, MoreRows& more, Emit& emit) {
    const LinkagePart& part = linkage_part(workspace);
    const bool several = part.drives.size() > 1;
    for (const LinkageDrive& each : part.drives) {
        value_row(part, each, emit);
        if (!several) speed_row(part, each, "speed", emit);
        const std::string name = each.joint + " speed";
        if (several)
            more.add(name, {"linkage.motor", {"joint"}}, each.rate != 0.0,
                     [&part, &each, &emit, name] { speed_row(part, each, name, emit); });
        const bool limited = std::ranges::count(part.shape->ranges, each.joint, &LinkageRange::joint) > 0;
        more.add(each.joint + " range", {"linkage.range", {"joint"}}, limited,
                 [&part, &each, &emit] { linkage_range_rows(part, each.joint, emit); });
    }
    if (part.drives.empty()) note("No motor yet: choose Motor, and click a joint.");
    motor_buttons(workspace, emit);
}

void length_rows(const LinkagePart& part, MoreRows& more, Emit& emit) {
    const Mechanism& mechanism = part.shape->mechanism;
    const MechanismKind* const kind = kind_of(mechanism);
    if (kind == nullptr) return note("Drawn by hand: click a joint, and set its bars on the right.");
    FieldRows rows(mechanism_fields(mechanism), kind->texts, "linkage.set", emit);
    for (const FieldText& text : kind->texts) rows.under(more).row(text.name);
}

}  // namespace

void LinkageLab::panel(const Workspace& workspace, Emit& emit) const {
    const LinkagePart& part = linkage_part(workspace);
    const auto section = [&](const char* title, bool at_first, const auto& rows) {
        folding_section(workspace, title, emit, at_first, rows);
    };
    section("Presets", true, [&](MoreRows&) { linkage_presets(emit); });
    section("Mouse", true, [&](MoreRows&) { linkage_tool_rows(part, emit); });
    section("Motors", true, [&](MoreRows& more) { driver_rows(workspace, more, emit); });
    section("Lengths", false, [&](MoreRows& more) { length_rows(part, more, emit); });
    section("Show", false, [&](MoreRows&) { past_rows(workspace, linkage_past(), emit); });
    section("Export", false, [&](MoreRows&) {
        if (row_button("Copy as C++", 1, true, "Copies the linkage as a C++ program that uses the library"))
            emit("linkage.copy");
        end_row();
        picture_rows(emit);
    });
}

namespace {

/// The remaining height, in lines of a plot's text.
float lines_left() {
    ImGui::PushFont(small_font());
    const float line = ImGui::GetFontSize();
    ImGui::PopFont();
    return ImGui::GetContentRegionAvail().y / line - 0.2f;
}

/// Plots the number against the leading joint, beside the plot over time.
void turn_plot(const Workspace& workspace, std::vector<Curve> curves, const std::string& unit) {
    const LinkagePart& part = linkage_part(workspace);
    auto& runtime = workspace.runtimes.of<LinkageRuntime>(linkage_lab);
    const LinkageTurn& turn = runtime.turn(part);
    const std::string& joint = part.linkage().links[turn.joint].name;
    const auto now = static_cast<float>(shown_value(part, joint, part.value_of(joint)).value);
    const Curve line = curves.front();
    const bool transmission = line.name == transmission_name, split = curves.size() > 1 || turn.whole;
    const float from = line.points.front().x, to = line.points.back().x;
    float high = 0.01f, value = std::numeric_limits<float>::quiet_NaN();
    for (const Curve& each : curves) {
        for (const glm::vec2& point : each.points) high = std::max(high, point.y);
        if (const float here = value_at(each, now); std::isfinite(here)) value = here;
    }
    if (std::isfinite(value))
        curves.push_back({.name = "now", .colour = line.colour, .points = {{now, value}}, .width = 1.7f});
    const PathSpeed fast = path_speed(runtime.path(part));
    const bool cut = unit == "m/s" && fast.exceeded;  // a speed has no limit at a dead point
    std::string title = transmission ? line.name + " (poor below 40)" : line.name;
    const float room = ImGui::GetContentRegionAvail().x - 4.0f * ImGui::GetFontSize();
    if (ImGui::CalcTextSize(title.c_str()).x > room) title = line.name;
    plot("turn plot", curves,
         {.x = joint.c_str(),
          .x_unit = turns(part, joint) ? "deg" : "m",
          .y = title.c_str(),
          .y_unit = unit.c_str(),
          .min_y = 0.0f,
          .from_x = split ? 0.0f : from,
          .min_x = split ? 360.0f : to,
          .low_y = 0.0f,
          .high_y = transmission ? 90.0f
                    : cut        ? static_cast<float>(fast.fast)
                                 : 1.1f * high,
          .fixed_y = cut,
          .level = transmission ? static_cast<float>(poor_transmission) : 0.0f,
          .at_x = now},
         lines_left());
}

}  // namespace

void LinkageLab::timeline(const Workspace& workspace, Emit& emit) const {
    const auto curve = linkage_past().curve(workspace);
    std::vector<Curve> over_turn;
    if (curve) over_turn = linkage_turn_curves(workspace, *curve);
    const bool beside = !over_turn.empty();
    constexpr float share = 0.62f;
    if (beside) {
        const float gap = ImGui::GetStyle().ItemSpacing.x;
        ImGui::BeginChild("over time", {share * (ImGui::GetContentRegionAvail().x - gap), 0.0f});
    }
    Lab::timeline(workspace, emit);
    if (!beside) return;
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("over a turn");
    turn_plot(workspace, std::move(over_turn), curve->unit);
    ImGui::EndChild();
}

}  // namespace tendril::app
