#include <imgui.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "app/document/units.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/panels.hpp"
#include "app/labs/chain/past.hpp"
#include "app/labs/chain/presets.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/labs/kit/past_strip.hpp"
#include "app/labs/kit/preset_rows.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/timeline.hpp"

namespace tendril::app {
namespace {

/// Length that the next added or inserted segment gets: a wish of the panel, no part of the document.
float length_of_next() {
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    const ImGuiID kept_as = ImGui::GetID("next length");
    float length = kept.GetFloat(kept_as, 1.0f);
    if (number_field("new bone", length, 0.01f, 0.0f, 1000.0f, "%.3f m")) kept.SetFloat(kept_as, length);
    explain("The length of the bone that Add or Insert makes next.");
    return length;
}

/// As people ask for them: to reach first, then the four that trail.
constexpr std::array modes_in_panel{ChainMode::Reach, ChainMode::Forward, ChainMode::Backward,
                                    ChainMode::Fixed, ChainMode::WithIndex};

void mode_rows(const ChainPart& part, const Palette& colours, Emit& emit) {
    std::vector<std::string> helps;
    std::size_t shown = 0;
    for (const ChainMode mode : modes_in_panel) {
        if (option_button(chain_modes.title(mode), part.mode == mode, chain_modes.help(mode)))
            emit("chain.mode", {{"mode", chain_modes.name(mode)}});
        draw_mode(mode, colours);
        if (mode == part.mode) shown = helps.size();
        helps.emplace_back(chain_modes.help(mode));
    }
    note_of(helps, shown);

    const auto with = [&](const char* name, ArgumentValue value) {
        emit.continuously("chain.mode", {{"mode", chain_modes.name(part.mode)}, {name, std::move(value)}});
    };
    if (part.mode == ChainMode::WithIndex && !part.chain.empty()) {
        int index = static_cast<int>(part.index);
        if (integer_slider("index", index, 0, static_cast<int>(part.chain.size()) - 1)) with("index", index);
        explain("The joint that goes to the target; the joints on both sides of it trail.");
    }
    if (part.mode == ChainMode::Fixed) {
        int iterations = iterations_of(part, part.mode);
        if (integer_field("iterations", iterations, 1, max_iterations)) with("iterations", iterations);
        explain("The maximum of passes in a solve. More come nearer to the target and cost more.");
        float tolerance = part.tolerance;
        if (number_field("tolerance", tolerance, 0.0005f, 0.0f, 10.0f, "%.4f m"))
            with("tolerance", tolerance);
        explain("How far from the target the solver may stop. Less is exact and takes more iterations.");
    }
}

void segment_rows(const ChainPart& part, Emit& emit) {
    const float length = length_of_next();
    if (row_button("Add", 3, true, "Adds a joint at the end, with a bone of that length"))
        emit("chain.add", {{"length", length}});
    const auto selected = part.selection.active();
    const bool several = part.selection.several();
    if (row_button("Insert", 3, selected.has_value(), "Inserts a joint before the selected one"))
        emit("chain.insert", {{"index", *selected}, {"length", length}});
    if (row_button("Remove", 3, selected.has_value(),
                   several ? "Removes the selected joints" : "Removes the selected joint"))
        emit("chain.remove_selected");
    if (selected) {
        const std::string name = several ? count_text(part.selection.all().size(), "bone")
                                         : "bone of joint " + std::to_string(*selected);
        length_field(name.c_str(), part, emit);
    } else {
        note(part.chain.empty() ? "Add a joint, or take a preset." : "Click a joint to select it.");
    }
}

void target_rows(const ChainPart& part, bool playing, Emit& emit) {
    glm::vec3 target = part.target;
    if (point_field("target", target, 0.01f)) emit.continuously("chain.target", {{"to", target}});
    explain("Where the target is. It can be dragged in the picture too.");

    const auto titles = motion_paths.titles();
    int path = static_cast<int>(part.motion.path);
    if (choice_field("moves", path, titles.data(), static_cast<int>(titles.size()))) {
        emit("chain.motion", {{"path", motion_paths.name(static_cast<Motion::Path>(path))}});
    }
    explain(
        "A path that the target follows while the simulation runs. It shows how a solver follows motion.");
    if (part.motion.path == Motion::Path::Still) return;
    if (!playing) note("The simulation is paused. Space runs it.");
    const auto with = [&](const char* name, float value) {
        emit.continuously("chain.motion", {{"path", motion_paths.name(part.motion.path)}, {name, value}});
    };
    float radius = part.motion.radius, period = part.motion.period;
    if (number_field("radius", radius, 0.01f, 0.0f, 1000.0f, "%.2f m")) with("radius", radius);
    explain("How far the path goes to each side of its middle.");
    if (number_field("period", period, 0.02f, min_period, max_period, "%.2f s")) with("period", period);
    explain("How long one round takes. Shorter is faster.");
}

constexpr PastHelp past_help{
    "What of the last ten seconds is plotted below the scene; angles are those of the selected joint",
    "Where the chain was, at every half second"};

void preset_rows(Emit& emit) {
    std::vector<PresetButton> buttons;
    for (const Preset& preset : presets()) {
        const bool reaches = std::string_view(preset.name) == reaching_arm;
        const std::string what = reaches ? ": an arm in mode reach, with a hinge and a pole target" : "";
        buttons.push_back({preset.name, preset.title, count_text(preset.count, "joint") + what, preset.of});
    }
    if (app::preset_rows(chain_lab, buttons, "Removes every joint", emit))
        emit("camera.frame", {{"what", "all"}});  // they differ in size
}

}  // namespace

void ChainLab::panel(const Workspace& workspace, Emit& emit) const {
    const ChainPart& part = chain_part(workspace);
    const auto open = [&](const char* title) { return folding_section(workspace, title, emit); };
    if (open("Presets")) preset_rows(emit);
    if (open("Mode and solver")) {
        mode_rows(part, palette(workspace.settings.theme), emit);
        if (part.mode == ChainMode::Reach) solver_rows(part, emit);
    }
    if (open("Joints")) segment_rows(part, emit);
    if (open("Target")) target_rows(part, workspace.clock.playing, emit);
    if (open("Analyse")) {
        study_rows(part, emit);
        past_view_rows(workspace, chain_past(), past_help, emit);
        if (part.mode == ChainMode::Reach) flip_rows(part.flips, chain_flip_words, emit);
    }
    if (open("Export")) export_rows(emit);
}

float ChainLab::timeline_height(const Workspace& workspace) const {
    const bool plots = chain_part(workspace).study.kind != Study::Kind::Microscope;
    return strip_height + (plots ? past_plot_height(workspace.settings, chain_past()) : 0.0f);
}

void ChainLab::timeline(const Workspace& workspace, Emit& emit) const {
    const ShownChain chain = shown_chain(workspace);
    const ChainPart& part = chain.part;
    if (chain.trace) {
        const Trace& trace = *chain.trace;
        const bool plays = part.study.pace > 0.0f;
        if (icon_button("play", plays ? Icon::Pause : Icon::Play,
                        plays ? "Pauses" : "Goes through the steps by itself", true, plays))
            emit(plays ? "microscope.pause" : "microscope.play");
        ImGui::SameLine();
        int shown = static_cast<int>(part.study.step);
        if (step_timeline("solve", shown, iteration_ends(trace))) {
            emit.continuously("microscope.seek", {{"step", shown}});
        }
        if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
            tell_strip("The steps of the solve. Drag shows the chain after one of them.");
        return;
    }
    const StripLine strip = past_strip(workspace, emit);
    past_plot(workspace, chain_past(), chain_past_curve(workspace), strip, emit);
}

}  // namespace tendril::app
