// What one chooses in the Rope lab: scene, tool, what there is, how it is simulated and shown.
#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>

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

/// A row of rope.settings.
void setting(const char* name, const char* key, float value, float speed, float low, float high,
             const char* format, const char* help, Emit& emit) {
    if (number_field(name, value, speed, low, high, format))
        emit.continuously("rope.settings", {{key, value}});
    explain(help);
}

void solver_rows(const RopePart& part, Emit& emit) {
    const rope::Settings& now = part.world->settings();
    for (const rope::Solver solver : {rope::Solver::Direct, rope::Solver::Xpbd, rope::Solver::Relaxation}) {
        if (option_button(rope_solvers.title(solver), now.solver == solver, rope_solvers.help(solver)))
            emit("rope.settings", {{"solver", rope_solvers.name(solver)}});
    }
    note(rope_solvers.help(now.solver));
    int iterations = now.iterations;
    if (integer_field("iterations", iterations, 1, 1000))
        emit.continuously("rope.settings", {{"iterations", iterations}});
    explain(now.solver == rope::Solver::Direct
                ? "The maximum of passes in a substep. Direct ends as soon as it has converged."
                : "Passes over all segments in a substep. More of them stretch a rope less, and cost more.");
    float per_second = static_cast<float>(1.0 / now.substep);
    if (number_field("substeps", per_second, 2.0f, 10.0f, 10000.0f, "%.0f /s"))
        emit.continuously("rope.settings", {{"substep", 1.0f / std::max(per_second, 1e-9f)}});
    explain(
        "Into how many equal steps a second of the simulation is cut. More of them follow fast motion better "
        "and cost more.");
    if (now.solver != rope::Solver::Relaxation)
        setting("compliance", "compliance", now.compliance, 1e-5f, 0.0f, 1.0f, "%.5f /N",
                "How elastic ropes are: by which part of its length a rope grows under a newton. 0 does not "
                "stretch.",
                emit);
}

void world_rows(const RopePart& part, Emit& emit) {
    const rope::Settings& now = part.world->settings();
    setting("damping", "damping", now.damping, 0.01f, 0.0f, 100.0f, "%.2f /s",
            "How fast motion dies away. Raise it where ropes swing for too long.", emit);
    setting("friction", "friction", now.friction, 0.01f, 0.0f, 10.0f, "%.2f",
            "Coulomb's coefficient between ropes and colliders. At 0 ropes slide off; more holds them.",
            emit);
    glm::vec3 gravity = now.gravity, wind = now.external;
    constexpr const char* unit = "%.2f m/s\xC2\xB2";
    constexpr float most = rope::max_acceleration;
    if (point_field("gravity", gravity, 0.05f, most, unit))
        emit.continuously("rope.settings", {{"gravity", gravity}});
    explain("The acceleration by weight, along each axis; Y points up. On Earth it is 0, -9.81, 0.");
    if (point_field("wind", wind, 0.05f, most, unit))
        emit.continuously("rope.settings", {{"external", wind}});
    explain("A steady acceleration of everything that moves, beside gravity.");
}

void time_rows(const Workspace& workspace, Emit& emit) {
    const RopePart& part = rope_part(workspace);
    float percent = 100.0f * workspace.clock.speed;
    if (number_field("speed", percent, 0.5f, 5.0f, 200.0f, "%.0f %%"))
        emit.continuously("time.speed", {{"factor", percent / 100.0f}});
    explain("How fast time passes in the lab. Under 100 % is slow motion.");
    float longest = 1000.0f * part.world->settings().longest_frame;
    if (number_field("longest frame", longest, 1.0f, 1.0f, 1000.0f, "%.0f ms"))
        emit.continuously("rope.settings", {{"longest_frame", longest / 1000.0f}});
    explain(
        "How much time a frame simulates at most; what is over is dropped. So a frame that took long does "
        "not "
        "make the next one take longer.");
    float dial = 100.0f * part.jitter.dial;
    if (number_field("frame-time jitter", dial, 0.5f, 0.0f, 100.0f, "%.0f %%"))
        emit.continuously("rope.jitter", {{"dial", dial / 100.0f}});
    explain("How uneven frames are: 0 is even frames, 100 is frames of 1 to 250 ms.");
    note(part.jitter.dial > 0.0f
             ? "Frames of 1 to 250 ms: the picture stutters, the simulation stays the same."
             : "Frame-time jitter cuts time into uneven frames, as a program that stutters does.");
}

void view_rows(const RopePart& part, Emit& emit) {
    bool strain = part.view.strain, particles = part.view.particles;
    if (ImGui::Checkbox("Strain as colour", &strain)) emit("rope.view", {{"strain", strain}});
    explain("Colours each rope by how far its segments are from their lengths.");
    if (ImGui::Checkbox("Particles", &particles)) emit("rope.view", {{"particles", particles}});
    explain("Draws the particles that ropes are made of.");
    int sides = part.view.sides;
    if (integer_slider("sides", sides, fewest_sides, most_sides))
        emit.continuously("rope.view", {{"sides", sides}});
    explain("How many sides ropes have in the picture. More look rounder and take longer to draw.");
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
    if (open("World")) world_rows(part, emit);
    if (open("Time")) time_rows(workspace, emit);
    if (open("Show")) view_rows(part, emit);
    if (open("Last ten seconds")) past_view_rows(workspace, rope_past(), past_help, emit);
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
