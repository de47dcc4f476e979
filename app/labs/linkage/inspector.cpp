// The Linkage lab's inspector: the linkage's state, its motor's range, and the selected joint.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/fields/field_rows.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/linkage/linkage_lab.hpp"
#include "app/labs/linkage/measures.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

/// The motor's range, and how well it pushes there.
void motor_rows(const Workspace& workspace) {
    const LinkagePart& part = linkage_part(workspace);
    const LinkageTurn& turn = workspace.runtimes.of<LinkageRuntime>(linkage_lab).turn(part);
    if (part.drives.empty() || turn.poses.size() < 2) return;
    const PanelSection ids("Motor");
    const std::string& joint = part.linkage().links[turn.joint].name;
    const auto end = [&](const LinkageTurn::Pose& pose) {
        return fixed_text(shown_value(part, joint, pose.value).value, turns(part, joint) ? 1 : 3);
    };
    if (const std::string kind = four_bar_kind(part); !kind.empty()) {
        reading("four-bar", "%s", kind.c_str());
        explain(
            "By Grashof's rule: if the shortest and the longest bar together are shorter than the other two, "
            "the shortest goes all round. A crank-rocker has it as its crank, a drag link as its ground, a "
            "double rocker as its coupler. In a triple rocker no bar does.");
    }
    if (turn.whole)
        reading("travel", "all round");
    else
        reading("travel", "%s to %s %s", end(turn.poses.front()).c_str(), end(turn.poses.back()).c_str(),
                turns(part, joint) ? "degrees" : "m");
    explain("How far the motor goes in this assembly mode, between dead points or the ends of its range.");
    const double now = transmission_angle(part);
    const auto worst = worst_transmission(part, turn);
    if (!std::isfinite(now) || !worst) return;
    reading("transmission angle", "%.1f degrees", now);
    explain(
        "Between the coupler and the link it moves: near 90 degrees it pushes well, below 40 poorly, at 0 "
        "not at all (dead point).");
    const char* const judged = worst->degrees < 0.5                 ? ", dead point"
                               : worst->degrees < poor_transmission ? ", poor"
                                                                    : "";
    reading("minimum", "%.1f degrees%s", worst->degrees, judged);
    explain(
        "The smallest over all its travel. Below 40 degrees most of the coupler's force goes into the pins. "
        "The plot of the transmission angle, under Show, draws it over the motor's angle.");
    reading(("at " + joint).c_str(), "%s", value_text(part, joint, worst->value).c_str());
    explain("The motor's value at that minimum.");
}

void freedom_rows(const LinkagePart& part) {
    const PanelSection ids("Degrees of freedom");
    const ik::LinkageFreedom freedom = freedom_of(part);
    reading("in this pose", "%d", freedom.actual);
    explain(
        "Counted from the equations in this pose, without motors. A floating piece has three in the plane: "
        "two to shift, one to turn.");
    reading("Gruebler's count", "%d", freedom.counted);
    explain(
        "Three per link minus two per joint. Counting alone misses redundant joints, and poses where bars "
        "are in line.");
    reading("loop error", "%s", error_text(part.result.report.closed_to).c_str());
    explain("The largest distance between two points that should be one; none: less than 0.01 mm.");
}

void bar_rows(const LinkagePart& part, std::size_t at, Emit& emit) {
    const ik::LinkageSketch& sketch = part.shape->sketch;
    for (const ik::SketchBar& bar : sketch.bars) {
        if (!is_on_bar(bar, at) || bar.points.size() != 2) continue;
        auto length = static_cast<float>(glm::distance(part.at(bar.points[0]), part.at(bar.points[1])));
        if (number_field(bar.name.c_str(), length, 0.01f, 1e-6f, 1e6f, "%.3f m"))
            emit.continuously("linkage.length", {{"bar", bar.name}, {"length", length}});
        explain(kind_of(part.shape->mechanism) == nullptr
                    ? "The bar's length; the others keep theirs."
                    : "The bar's length; the others keep theirs. Setting it makes the linkage one drawn by "
                      "hand.");
    }
}

/// Adds or removes a motor between two bars at a joint. Not shown for parts of one rigid body.
void pair_motor_row(const LinkageShape& shape, std::size_t at, std::size_t bar, std::size_t against,
                    Emit& emit) {
    if (shape.bodies[bar] == shape.bodies[against]) return;
    const ik::LinkageSketch& sketch = shape.sketch;
    const std::string &first = sketch.bars[bar].name, &second = sketch.bars[against].name;
    const auto motor = std::ranges::find_if(sketch.motors, [&](const ik::SketchMotor& each) {
        return each.point == at && std::minmax(each.bar, each.against) == std::minmax(bar, against);
    });
    if (motor != sketch.motors.end()) {
        if (row_button(("Remove " + motor->name).c_str(), 1, true, "Removes the motor between the bars"))
            emit("linkage.motor.remove", {{"joint", motor->name}});
    } else if (row_button(("Motor: " + first + " to " + second).c_str(), 1, true,
                          "Adds a motor that turns one bar against the other")) {
        emit("linkage.motor.add", {{"point", sketch.points[at].name}, {"bar", second}, {"against", first}});
    }
}

void pair_motor_rows(const LinkageShape& shape, std::size_t at, Emit& emit) {
    if (!chooses_pair(shape.sketch, at)) return;
    const std::vector<std::size_t> here = bars_at(shape.sketch, at);
    for (std::size_t i = 0; i < here.size(); ++i)
        for (std::size_t k = i + 1; k < here.size(); ++k) pair_motor_row(shape, at, here[i], here[k], emit);
    end_row();
}

void joint_rows(const LinkagePart& part, LinkageRuntime& runtime, Emit& emit) {
    const PanelSection ids("Joint");
    const auto at = part.linkage().find_point(part.selected);
    if (!at) return note("Click a joint to select it: its path is drawn.");
    const glm::dvec3 place = part.at(*at);
    const std::string speed = point_speed_text(part, part.selected, runtime);
    if (speed.empty()) {
        reading("name", "%s", part.selected.c_str());
        explain("Its name in files and commands.");
    } else {
        reading(("speed of " + part.selected).c_str(), "%s", speed.c_str());
        explain("At the motor's speed, or at the speed it would run at. Show plots it.");
    }
    reading("at", "%.3f  %.3f  %.3f m", place.x, place.y, place.z);
    explain("Its position: X, Y and Z.");
    std::string bars;
    const double angle = angle_at(part, part.selected, &bars);
    if (std::isfinite(angle)) {
        reading(("angle " + bars).c_str(), "%.1f degrees", angle);
        explain("Between its two bars; with a single bar, from +X.");
    }
    if (!part.shape->in_plane()) return;
    const ik::SketchHold hold = part.shape->sketch.points[*at].hold;
    const bool pinned = hold == ik::SketchHold::Pinned, guided = hold == ik::SketchHold::Guided;
    if (pinned) note("It stays in place. Click a joint that moves: its path is drawn.");
    bar_rows(part, *at, emit);
    if (row_option("Free", 3, !pinned && !guided, "Held only by its bars"))
        emit("linkage.pin", {{"point", part.selected}, {"on", false}});
    if (row_option("Pinned", 3, pinned, "Pinned to the ground"))
        emit("linkage.pin", {{"point", part.selected}, {"on", true}});
    if (row_option("Slides", 3, guided, "Slides on a line through its position"))
        emit("linkage.guide", {{"point", part.selected}});
    end_row();
    pair_motor_rows(*part.shape, *at, emit);
    if (guided) {
        FieldRows({guide_fields(), &part.shape->sketch.points[*at]}, field_texts<ik::SketchPoint>(),
                  "linkage.guide", emit, {{"point", part.selected}})
            .all();
        if (part.linkage().find_link(part.selected)) linkage_range_rows(part, part.selected, emit);
    }
}

}  // namespace

void LinkageLab::inspector(const Workspace& workspace, Emit& emit) const {
    const LinkagePart& part = linkage_part(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    auto& runtime = workspace.runtimes.of<LinkageRuntime>(linkage_lab);
    show_verdict(linkage_verdict(part, runtime, workspace.clock.playing), colours, emit,
                 {.notes = 4, .paragraphs = 2}, [&] {
                     for (const Cure& each : ways_on(part, runtime)) cure_line(each.text, each, emit);
                 });
    freedom_rows(part);
    motor_rows(workspace);
    joint_rows(part, runtime, emit);
    incident_rows(workspace, colours, emit);
}

}  // namespace tendril::app
