// What one chooses in the Rope lab: scene, tool, what there is, how it is simulated and shown.
#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "app/fields/field_rows.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/labs/kit/past_strip.hpp"
#include "app/labs/kit/preset_rows.hpp"
#include "app/labs/rope/panels.hpp"
#include "app/labs/rope/past.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_names.hpp"
#include "app/labs/rope/scenes.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

void scene_rows(Emit& emit) {
    std::vector<PresetButton> buttons;
    for (const RopeSceneEntry& scene : rope_scenes())
        buttons.push_back({scene.name, scene.title, scene.help});
    preset_rows(rope_lab, buttons, "Removes every rope and collider", emit);
}

const char* tool_help(RopeTool tool) {
    switch (tool) {
        case RopeTool::Pin:
            return "A click on a particle pins it where it is, or lets a pinned one move again.";
        case RopeTool::Cut:
            return "A click on a rope cuts the segment that is there.";
        default:
            return "A click selects: the inspector then has what can be set.";
    }
}

void tool_rows(const RopePart& part, Emit& emit) {
    for (const RopeTool tool : rope_tools.values()) {
        if (option_button(rope_tools.title(tool), part.tool == tool, tool_help(tool)))
            emit("rope.tool", {{"name", rope_tools.name(tool)}});
    }
    note(part.tool == RopeTool::Cut ? "Click a segment of a rope to cut it there."
                                    : "Drag any particle of a rope, and any collider.");
}

FieldRows settings_rows(const RopePart& part, Emit& emit) {
    return FieldRows(part.world->settings(), "rope.settings", emit);
}

void solver_rows(const RopePart& part, Emit& emit) {
    const rope::Settings& now = part.world->settings();
    const FieldRows settings = settings_rows(part, emit);
    settings.row("solver");
    note(rope_solvers.help(now.solver));
    settings.row("iterations");
    float per_second = static_cast<float>(1.0 / now.substep);
    if (number_field("substeps", per_second, 2.0f, 10.0f, 10000.0f, "%.0f /s"))
        emit.continuously("rope.settings", {{"substep", 1.0f / std::max(per_second, 1e-9f)}});
    explain(
        "Into how many equal steps a second of the simulation is cut. More of them follow fast motion better "
        "and cost more.");
    if (now.solver != rope::Solver::Relaxation) settings.row("compliance");
}

void time_rows(const Workspace& workspace, Emit& emit) {
    const RopePart& part = rope_part(workspace);
    float percent = 100.0f * workspace.clock.speed;
    if (number_field("speed", percent, 0.5f, 5.0f, 200.0f, "%.0f %%"))
        emit.continuously("time.speed", {{"factor", percent / 100.0f}});
    explain("How fast time passes in the lab. Under 100 % is slow motion.");
    settings_rows(part, emit).row("longest_frame");
    float dial = 100.0f * part.jitter.dial;
    if (number_field("frame-time jitter", dial, 0.5f, 0.0f, 100.0f, "%.0f %%"))
        emit.continuously("rope.jitter", {{"dial", dial / 100.0f}});
    explain("How uneven frames are: 0 is even frames, 100 is frames of 1 to 250 ms.");
    note(part.jitter.dial > 0.0f
             ? "Frames of 1 to 250 ms: the picture stutters, the simulation stays the same."
             : "Frame-time jitter cuts time into uneven frames, as a program that stutters does.");
}

constexpr PastHelp past_help{
    "What of the last ten seconds is plotted below the scene: of the selected particles or their body, or of "
    "all ropes where none is selected",
    "Where the ropes were, at every half second"};

}  // namespace

void RopeLab::panel(const Workspace& workspace, Emit& emit) const {
    const RopePart& part = rope_part(workspace);
    const auto open = [&](const char* title) { return folding_section(workspace, title, emit); };
    if (open("Presets")) scene_rows(emit);
    if (open("Click action")) tool_rows(part, emit);
    if (open("Add")) adding_rows(workspace, emit);
    if (open("Solver")) solver_rows(part, emit);
    if (open("World"))
        settings_rows(part, emit).rows("damping", "friction", "gravity", "gravity_scale", "external");
    if (open("Time")) time_rows(workspace, emit);
    if (open("Show")) FieldRows(part.view, "rope.view", emit).rows("strain", "particles", "sides");
    if (open("Last ten seconds")) past_view_rows(workspace, rope_past(), past_help, emit);
    if (!open("Export")) return;
    if (row_button("Copy as C++", 1, true,
                   "Copies ropes and colliders as a C++ program that uses the library"))
        emit("rope.copy");
    end_row();
}

void RopeLab::inspector(const Workspace& workspace, Emit& emit) const {
    show_verdict(rope_verdict(rope_part(workspace)), palette(workspace.settings.theme));
    selection_rows(workspace, emit);
    number_rows(workspace, palette(workspace.settings.theme));
}

float RopeLab::timeline_height(const Workspace& workspace) const {
    return strip_height + past_plot_height(workspace.settings, rope_past());
}

void RopeLab::timeline(const Workspace& workspace, Emit& emit) const {
    const StripLine strip = past_strip(workspace, emit);
    past_plot(workspace, rope_past(), rope_past_curve(workspace), strip, emit);
}

}  // namespace tendril::app
