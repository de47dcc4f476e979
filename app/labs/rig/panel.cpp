// What one chooses in the Rig lab: a preset, elements, units, curves, which way to solve.
#include <imgui.h>

#include <algorithm>
#include <glm/trigonometric.hpp>

#include "app/document/json_complete.hpp"
#include "app/document/units.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/labs/kit/preset_rows.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/panels.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/time_panel.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

const char* preset_help(const std::string& name) {
    if (name == "aim")
        return "A head looks at one control; another, which goes with the first, says where up is";
    if (name == "fk") return "A tentacle of controls, turned by one dial, and the bones that follow them";
    if (name == "loop") return "Five arms that one dial curls, by a for-each";
    if (name == "morph") return "A blob whose shape and colour follow controls through curves";
    if (name == "secondary") return "Two antennae that trail a head by springs";
    return "";
}

void preset_section(Emit& emit) {
    std::vector<PresetButton> buttons;
    for (const RigPreset& preset : rig_presets()) {
        const bool short_title = preset.title.size() < 6;  // three of these fit side by side
        buttons.push_back({preset.name, preset.title, preset_help(preset.name), short_title ? 3 : 1});
    }
    preset_rows(rig_lab, buttons, "Removes every element, curve and unit", emit);
}

/// What is left of each bone, the most first.
void residual_rows(const RigPanel& panel, const BackwardLeft& left) {
    std::vector<std::size_t> bones;
    for (std::size_t i = 0; i < left.elements.size(); ++i)
        if (panel.part.rig.definition().elements[i].kind == rig::ElementKind::Bone) bones.push_back(i);
    std::stable_sort(bones.begin(), bones.end(), [&](std::size_t a, std::size_t b) {
        return amount(left.elements[a]) > amount(left.elements[b]);
    });
    constexpr std::size_t shown = 8;
    for (std::size_t i = 0; i < std::min(shown, bones.size()); ++i) {
        const std::string& name = panel.part.rig.definition().elements[bones[i]].name;
        const rig::Residual& each = left.elements[bones[i]];
        reading(elided(name, 0.4f * ImGui::GetContentRegionAvail().x).c_str(), "%s",
                left_text(1000.0 * each.metres, glm::degrees(each.radians), each.scale).c_str());
    }
    if (bones.size() > shown) note("and " + count_text(bones.size() - shown, "bone") + " with less");
}

}  // namespace

RigPanel rig_panel(const Workspace& workspace, Emit& emit) {
    auto& runtime = workspace.runtimes.of<RigRuntime>(rig_lab);
    return {workspace,
            rig_part(workspace),
            runtime,
            runtime.resolved(workspace),
            palette(workspace.settings.theme),
            emit};
}

void RigPanel::edit(const char* command, const ArgumentList& arguments) const {
    emit.continuously(command, arguments);
    if (!workspace.clock.playing) emit.continuously("rig.solve");
}

LabSetting pending_marks() {
    return {
        .key = "pending_poses",
        .command = "view.pending_poses",
        .title = "Mark pending poses in the tree",
        .argument = "marks",
        .help = "Marks in the tree of the Rig lab which local and global transforms wait to be worked out",
        .choices = {{"shown", "Pending poses marked"}, {"hidden", "Not marked"}}};
}

NamedArgument which(const RigPart& part, const std::vector<std::size_t>& elements) {
    std::vector<std::string> names = names_of(part, elements);
    if (names.size() == 1) return {"name", names.front()};
    return {"names", SharedJson(Json(std::move(names)))};
}

void select_element(const RigPanel& panel, const std::string& name) {
    panel.emit("rig.select", {{"element", name}, {"unit", panel.part.selected.unit}});
}
void select_unit(const RigPanel& panel, const std::string& name) {
    panel.emit("rig.select", {{"unit", name}, {"add", true}});
}

void curve_rows(const RigPanel& panel) {
    const std::vector<rig::NamedCurve>& curves = panel.part.rig.definition().curves;
    if (curves.empty()) return;
    if (!folding_section(panel.workspace, "Curves", panel.emit)) return;
    for (std::size_t i = 0; i < std::min<std::size_t>(curves.size(), 100); ++i) {
        reading(curves[i].name.c_str(), "%s", fixed_text(panel.part.state.curves[i], 3).c_str());
        explain("A number that units write: a morph weight, a value of a material.");
    }
    if (curves.size() > 100) note("and " + count_text(curves.size() - 100, "curve") + " more");
}

void solve_rows(const RigPanel& panel) {
    if (row_button("Forward", 2, true, "Runs the units: from controls to bones. A tick does this too"))
        panel.emit("rig.solve", {{"direction", "forward"}});
    if (row_button("Backward", 2, true,
                   "Sets the controls so that the bones stay as they are, if that can be. Begins a take"))
        panel.emit("rig.solve", {{"direction", "backward"}});
    end_row();
    if (!panel.part.backward) return;
    const BackwardLeft& left = *panel.part.backward;
    if (left.bone.empty()) return note("Without a bone there is nothing to match.");
    if (left.expressed()) return note("The controls give every bone's pose.");
    note(left.stopped ? "Stopped before the end, for the rig is large: there may be values that come nearer. "
                        "What is left, worst first:"
                      : "The controls cannot give the pose. What is left, worst first:");
    residual_rows(panel, left);
}

void RigLab::panel(const Workspace& workspace, Emit& emit) const {
    const RigPanel panel = rig_panel(workspace, emit);
    const auto open = [&](const char* title) { return folding_section(workspace, title, emit); };
    if (open("Presets")) preset_section(emit);
    walk_rows(workspace, emit);
    if (open("Elements")) element_tree(panel);
    if (open("Units, in order")) unit_list(panel);
    curve_rows(panel);
    if (open("Solve")) solve_rows(panel);
    time_rows(workspace, emit);
    if (!open("Export")) return;
    if (row_button("Copy as C++", 1, true, "The rig as it is set, as a program against the library"))
        emit("rig.copy");
}

}  // namespace tendril::app
