// What is selected in the Humanoid lab, and the character in numbers.
#include <imgui.h>

#include <filesystem>

#include "app/document/units.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/ik/chains.hpp"
#include "app/labs/humanoid/node_selection.hpp"
#include "app/labs/humanoid/panels.hpp"
#include "app/labs/kit/incident_rows.hpp"
#include "app/labs/kit/name_list.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

void text_row(const char* name, const std::string& value) {
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(name).x - ImGui::GetFontSize();
    reading(name, "%s", elided(value, free).c_str());
    explain(value.c_str());
}

void position_rows(const glm::dvec3& at) {
    reading("x", "%.4f m", at.x);
    reading("y", "%.4f m", at.y);
    reading("z", "%.4f m", at.z);
}

}  // namespace

void node_inspector(const HumanoidPanel& panel) {
    section("Selection");
    const HumanoidPart& part = panel.part;
    const auto node = part.selection.active();
    if (!node) return note("Nothing is selected.");
    const std::string& name = part.skeleton()[*node].name;
    if (part.selection.several()) {
        reading("nodes", "%zu", part.selection.all().size());
        note(name_list_text(names_of(part.selection, part.skeleton())));
        note("Shown is " + name + ".");
    }
    text_row("node", name);
    const auto bone = part.bone_of(*node);
    text_row("bone", bone ? humanoid::name(*bone) : "none of the body");
    const std::int32_t parent = part.skeleton()[*node].parent;
    text_row("hangs on", parent < 0 ? "nothing" : part.skeleton()[static_cast<std::size_t>(parent)].name);
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    position_rows(shown.placed[*node].position);
    if (!shown.before.empty())
        reading("from before", "%.1f mm",
                1000.0 * glm::distance(shown.placed[*node].position, shown.before[*node].position));
    spring_inspector(panel);
}

void target_inspector(const HumanoidPanel& panel) {
    if (!panel.part.ik.has_targets()) return;
    section("Targets");
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    if (!shown.refused.empty()) return note(shown.refused);
    for (const humanoid::Effector effector : all_effectors) {
        if (!panel.part.ik.target(effector)) continue;
        reading(title(effector).c_str(), "%.1f mm", 1000.0 * shown.residual(effector).value_or(0.0));
        explain("How far the effector is from its target.");
    }
    if (!shown.body) return;
    std::string limited;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (shown.body->at_limit[i])
            limited +=
                (limited.empty() ? "" : ", ") + std::string(humanoid::name(static_cast<humanoid::Bone>(i)));
    note(limited.empty() ? "No joint is at its limit." : "At their limits: " + limited + ".");
}

void character_inspector(const HumanoidPanel& panel) {
    section("Character");
    const LoadedCharacter& loaded = *panel.part.loaded;
    text_row("from",
             loaded.file.empty() ? "the program" : std::filesystem::path(loaded.file).filename().string());
    reading("nodes", "%zu", loaded.skeleton().size());
    reading("clips", "%zu", loaded.clips().size());
    if (const humanoid::Clip* clip = panel.part.clip()) {
        section("Clip");
        text_row("name", clip->name);
        reading("time", "%.2f of %.2f s", panel.part.playback.time, clip->duration);
        if (panel.part.playback.rounds > 0)
            reading("round", "%lld", static_cast<long long>(panel.part.playback.rounds + 1));
    }
}

void HumanoidLab::inspector(const Workspace& workspace, Emit& emit) const {
    const HumanoidPanel panel = humanoid_panel(workspace, emit);
    show_verdict(humanoid_verdict(workspace), panel.colours);
    const bool selected = !panel.part.selection.empty();
    if (selected) node_inspector(panel);  // what was clicked comes first
    limit_inspector(panel);
    target_inspector(panel);
    character_inspector(panel);
    if (!selected) node_inspector(panel);
    incident_rows(workspace, panel.colours, emit);
}

}  // namespace tendril::app
