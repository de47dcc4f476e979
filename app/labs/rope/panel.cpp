// What one chooses in the Rope lab: scene, tool, what there is, how it is simulated and shown.
#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/labs/kit/folding.hpp"
#include "app/labs/kit/past_strip.hpp"
#include "app/labs/kit/preset_rows.hpp"
#include "app/labs/rope/panels.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_names.hpp"
#include "app/labs/rope/scenes.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

void scene_rows(Emit& emit) {
    std::vector<PresetButton> buttons;
    for (const RopeSceneEntry& scene : rope_scenes()) buttons.push_back({scene.name, scene.title});
    preset_rows(rope_lab, buttons, "Removes every rope and collider", emit);
}

void tool_rows(const RopePart& part, Emit& emit) {
    for (const RopeTool tool : rope_tools.values()) {
        if (option_button(rope_tools.title(tool), part.tool == tool))
            emit("rope.tool", {{"name", rope_tools.name(tool)}});
    }
    note(part.tool == RopeTool::Cut ? "Click a segment of a rope to cut it there."
                                    : "Drag any particle of a rope, and any collider.");
}

/// A row of rope.settings.
void setting(const char* name, const char* key, float value, float speed, float low, float high,
             const char* format, Emit& emit) {
    if (number_field(name, value, speed, low, high, format))
        emit.continuously("rope.settings", {{key, value}});
}

void solver_rows(const RopePart& part, Emit& emit) {
    const rope::Settings& now = part.world->settings();
    for (const rope::Solver solver : {rope::Solver::Direct, rope::Solver::Xpbd, rope::Solver::Relaxation}) {
        if (option_button(rope_solvers.title(solver), now.solver == solver))
            emit("rope.settings", {{"solver", rope_solvers.name(solver)}});
    }
    note(rope_solvers.help(now.solver));
    int iterations = now.iterations;
    if (integer_field("iterations", iterations, 1, 1000))
        emit.continuously("rope.settings", {{"iterations", iterations}});
    float per_second = static_cast<float>(1.0 / now.substep);
    if (number_field("substeps", per_second, 2.0f, 10.0f, 10000.0f, "%.0f /s"))
        emit.continuously("rope.settings", {{"substep", 1.0f / std::max(per_second, 1e-9f)}});
    if (now.solver != rope::Solver::Relaxation)
        setting("compliance", "compliance", now.compliance, 1e-5f, 0.0f, 1.0f, "%.5f /N", emit);
}

void world_rows(const RopePart& part, Emit& emit) {
    const rope::Settings& now = part.world->settings();
    setting("damping", "damping", now.damping, 0.01f, 0.0f, 100.0f, "%.2f /s", emit);
    setting("friction", "friction", now.friction, 0.01f, 0.0f, 10.0f, "%.2f", emit);
    glm::vec3 gravity = now.gravity, wind = now.external;
    constexpr const char* unit = "%.2f m/s\xC2\xB2";
    constexpr float most = rope::max_acceleration;
    if (point_field("gravity", gravity, 0.05f, most, unit))
        emit.continuously("rope.settings", {{"gravity", gravity}});
    if (point_field("wind", wind, 0.05f, most, unit))
        emit.continuously("rope.settings", {{"external", wind}});
}

void time_rows(const Workspace& workspace, Emit& emit) {
    const RopePart& part = rope_part(workspace);
    float percent = 100.0f * workspace.clock.speed;
    if (number_field("speed", percent, 0.5f, 5.0f, 200.0f, "%.0f %%"))
        emit.continuously("time.speed", {{"factor", percent / 100.0f}});
    float longest = 1000.0f * part.world->settings().longest_frame;
    if (number_field("longest frame", longest, 1.0f, 1.0f, 1000.0f, "%.0f ms"))
        emit.continuously("rope.settings", {{"longest_frame", longest / 1000.0f}});
    float dial = 100.0f * part.jitter.dial;
    if (number_field("frame-time jitter", dial, 0.5f, 0.0f, 100.0f, "%.0f %%"))
        emit.continuously("rope.jitter", {{"dial", dial / 100.0f}});
    note(part.jitter.dial > 0.0f
             ? "Frames of 1 to 250 ms: the picture stutters, the simulation stays the same."
             : "Frame-time jitter cuts time into uneven frames, as a program that stutters does.");
}

void view_rows(const RopePart& part, Emit& emit) {
    bool strain = part.view.strain, particles = part.view.particles;
    if (ImGui::Checkbox("Strain as colour", &strain)) emit("rope.view", {{"strain", strain}});
    if (ImGui::Checkbox("Particles", &particles)) emit("rope.view", {{"particles", particles}});
    int sides = part.view.sides;
    if (integer_slider("sides", sides, fewest_sides, most_sides))
        emit.continuously("rope.view", {{"sides", sides}});
}

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
}

void RopeLab::inspector(const Workspace& workspace, Emit& emit) const {
    selection_rows(workspace, emit);
    number_rows(workspace, palette(workspace.settings.theme));
}

void RopeLab::timeline(const Workspace& workspace, Emit& emit) const {
    past_strip(workspace, emit);
}

}  // namespace tendril::app
