#include "app/labs/rig/panel.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/time_panel.hpp"
#include "app/labs/rig/values.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

// Sections of the left panel: presets, elements, units, curves, solving.

namespace {

void preset_section(Emit& emit) {
    std::vector<PresetButton> buttons;
    for (const RigPreset& preset : rig_presets()) buttons.push_back({preset.name, preset.title, preset.help});
    preset_rows(rig_lab, buttons, "Removes every element, curve and unit", emit);
}

/// Residuals of the bones, largest first.
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
    if (bones.size() > shown)
        note("and " + count_text(bones.size() - shown, "bone") + " with smaller errors");
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

NamedArgument which(const RigPart& part, const std::vector<std::size_t>& elements) {
    return one_or_list("name", "names", names_of(part, elements));
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
    const FoldingSection open(panel.workspace, "Curves", panel.emit, false);
    if (!open) return;
    for (std::size_t i = 0; i < std::min<std::size_t>(curves.size(), 100); ++i) {
        reading(curves[i].name.c_str(), "%s", fixed_text(panel.part.state->curves[i], 3).c_str());
        explain("A number that units write, such as a morph weight or a material parameter.");
    }
    if (curves.size() > 100) note("and " + count_text(curves.size() - 100, "curve") + " more");
}

void solve_rows(const RigPanel& panel) {
    if (row_button("Forward", 2, true, "Runs the units, from controls to bones, as every tick does"))
        panel.emit("rig.solve", {{"direction", "forward"}});
    if (row_button("Backward", 2, true,
                   "Sets the controls so that the bones keep their poses, if possible. Starts a take"))
        panel.emit("rig.solve", {{"direction", "backward"}});
    end_row();
    if (!panel.part.backward) return;
    const BackwardLeft& left = *panel.part.backward;
    if (left.bone.empty()) return note("There are no bones to match.");
    if (left.expressed()) return note("The controls can give every bone its pose.");
    note(left.stopped
             ? "Stopped early, as the rig is large: there may be closer values. Errors left, worst first:"
             : "The controls cannot give the pose. Errors left, worst first:");
    residual_rows(panel, left);
}

void RigLab::panel(const Workspace& workspace, Emit& emit) const {
    const RigPanel panel = rig_panel(workspace, emit);
    if (const FoldingSection open(workspace, "Presets", emit); open) preset_section(emit);
    walk_rows(workspace, emit);
    if (const FoldingSection open(workspace, "Elements", emit, false); open) element_tree(panel);
    if (const FoldingSection open(workspace, "Units, in order", emit); open) unit_list(panel);
    curve_rows(panel);
    if (const FoldingSection open(workspace, "Solve", emit, false); open) solve_rows(panel);
    time_rows(workspace, emit);
    const FoldingSection open(workspace, "Export", emit, false);
    if (!open) return;
    if (row_button("Copy as C++", 1, true,
                   "This rig in its present state, as a program that uses the library"))
        emit("rig.copy");
    end_row();
    picture_rows(emit);
    const bool recorded = panel.part.clip != nullptr;
    if (row_button(
            "Export clip", 1, recorded,
            recorded ? "The bones and how they moved, as a new GLB file" : "Record a clip first, under Clip"))
        emit("rig.clip.export");
    end_row();
}

// Sections of the right panel: the selected element with its poses, the selected unit with its inputs.

namespace {

constexpr float max_coordinate = 1e9f;

void text_line(const char* name, const std::string& value, const char* what = "") {
    ImGui::TextDisabled("%s", name);
    if (*what != '\0') explain(what);
    ImGui::SameLine();
    text_flush_right(elided(value, ImGui::GetContentRegionAvail().x));
}

/// Read only: translation, rotation, and scale if it is not 1.
void pose_lines(const char* title, const rig::Transform& pose, const char* what) {
    text_line(title, vector_text(pose.translation, 3) + " m", what);
    text_line("", rotation_text(pose.rotation) + "\xC2\xB0");
    if (pose.scale != rig::Transform().scale) text_line("", "scale " + vector_text(pose.scale, 3));
}

void pending_rows(const RigPanel& panel, std::size_t element) {
    const Selection& selected = panel.part.selected.elements;
    const rig::Pending pending = panel.part.state->elements.pending(panel.part.rig.id(element));
    text_line(
        "pending", rig::name(pending),
        "An element stores a local and a global transform. Writing one makes the other pending, along with "
        "the global ones of all elements below. A pending one is computed when something reads it.");
    if (row_button(selected.several() ? "Read them" : "Read it", 2, true,
                   "Computes the pending transforms from here up to the root, and says how many there were"))
        panel.emit("rig.read", {which(panel.part, selected.all())});
    end_row();
}

}  // namespace

glm::dvec3 edited_vector(const glm::dvec3& before, glm::vec3 shown, glm::vec3 edited) {
    glm::dvec3 result = before;
    for (int i = 0; i < 3; ++i)
        if (edited[i] != shown[i]) result[i] = shortest_decimal(edited[i]);
    return result;
}

bool rotation_field(const RigPanel& panel, const char* name, glm::dquat& rotation) {
    RigRuntime::Panel& kept = panel.runtime.panel;
    const bool same = std::abs(glm::dot(kept.rotation, rotation)) > 1.0 - 1e-12;
    const glm::dvec3 degrees = same ? kept.degrees : euler_degrees(rotation);
    const glm::vec3 shown(degrees);
    glm::vec3 edited = shown;
    const bool changed = vector_field(name, edited, 0.5f, glm::vec3(-360.0f), glm::vec3(360.0f), "%.1f");
    explain("The rotation about X, then Y, then Z, in degrees.");
    if (!changed) return false;
    kept.degrees = edited_vector(degrees, shown, edited);
    rotation = kept.rotation = from_euler_degrees(kept.degrees);
    return true;
}

std::optional<SharedJson> transform_fields(const RigPanel& panel, const rig::Transform& transform,
                                           glm::vec3 low, glm::vec3 high) {
    Json changed = Json::object();
    const glm::vec3 at(transform.translation), by(transform.scale);
    glm::vec3 edited = at;
    if (vector_field("translation, m", edited, 0.01f, low, high, "%.3f"))
        changed["translation"] = dpoint(edited_vector(transform.translation, at, edited));
    explain("How far it is moved along X, Y and Z, in metres.");
    glm::dquat rotation = transform.rotation;
    if (rotation_field(panel, "rotation, degrees", rotation)) changed["rotation"] = dquaternion(rotation);
    edited = by;
    if (vector_field("scale", edited, 0.01f, glm::vec3(-max_coordinate), glm::vec3(max_coordinate), "%.3f"))
        changed["scale"] = dpoint(edited_vector(transform.scale, by, edited));
    explain("The scale along X, Y and Z. 1 is the original size; 0 is not allowed.");
    if (changed.empty()) return std::nullopt;
    return SharedJson(std::move(changed));
}

void name_field(const RigPanel& panel, const char* command, const std::string& name, const char* help) {
    std::string to = name;
    ImGui::PushID(name.c_str());  // a name typed for one element must not carry over to another
    if (text_field("name", to, "a name") && to != name) panel.emit(command, {{"name", name}, {"to", to}});
    ImGui::PopID();
    explain(help);
}

void element_inspector(const RigPanel& panel) {
    const Selection& selected = panel.part.selected.elements;
    const PanelSection ids(selected.several() ? "Elements" : "Element");
    if (!selected.active())
        return note("Nothing is selected. Click an element, in the list or in the picture.");
    const rig::Element& element = panel.part.rig.definition().elements[*selected.active()];
    if (selected.several())
        note(count_text(selected.all().size(), "element") + ", " + element.name + " is shown");
    else
        name_field(panel, "rig.element.rename", element.name,
                   "Another name: units, paths and the clip follow.");
    text_line("kind", element.control ? control_title(element.control->kind) : rig::name(element.kind));
    if (!element.parent.empty()) text_line("parent", element.parent);
    control_rows(panel);
}

void pose_rows(const RigPanel& panel) {
    const auto found = panel.part.selected.elements.active();
    if (!found) return;
    const rig::Element& element = panel.part.rig.definition().elements[*found];
    const rig::ElementId id = panel.part.rig.id(*found);
    const PanelSection ids("Poses");
    pose_lines("local", *panel.now.known(id, rig::Space::Local), "Within its parent, after the last unit.");
    pose_lines("global", *panel.now.known(id, rig::Space::Global), "In the scene, after the last unit.");
    pose_lines("initial", *panel.now.known(id, rig::Space::Local, rig::Pose::Initial),
               "Within its parent, when it was added: the rest pose.");
    pending_rows(panel, *found);
    if (!element.control) {
        ImGui::TextUnformatted("Input pose, within its parent");
        explain("Every solve begins with it, before the first unit runs.");
        const std::vector<std::size_t> alike = selected_alike(panel.part);
        const rig::Transform input = *panel.now.known(id, rig::Space::Local, rig::Pose::Input);
        if (const auto changed =
                transform_fields(panel, input, glm::vec3(-max_coordinate), glm::vec3(max_coordinate)))
            panel.edit("rig.element.set",
                       {which(panel.part, alike),
                        {"transform", SharedJson(touched(**changed, transform_json(input)))}});
        scope_note(panel.part, alike.size(), "bones or nulls");
    }
}

void RigLab::inspector(const Workspace& workspace, Emit& emit) const {
    const RigPanel panel = rig_panel(workspace, emit);
    show_verdict(rig_verdict(panel.part), panel.colours, emit);
    if (panel.part.selected.unit_last) unit_inspector(panel);
    element_inspector(panel);
    why_rows(panel);
    pose_rows(panel);
    if (!panel.part.selected.unit_last) unit_inspector(panel);
    incident_rows(workspace, panel.colours, emit);  // last, so that fields stay put during a drag to a limit
}

Verdict rig_verdict(const RigPart& part) {
    std::size_t on = 0, all = 0, warned = 0;
    std::string first;
    const auto& units = part.rig.definition().units;
    for (const UnitRow& row : unit_rows(part)) {
        ++all;
        if (!row.unit->enabled || !units[row.top].enabled) continue;
        ++on;
        const rig::Warning warning = part.state->units[row.at].warning;
        if (warning == rig::Warning::None) continue;
        if (warned++ == 0) first = row.unit->name + ": " + rig::message(warning) + ".";
    }
    if (part.rig.definition().elements.empty())
        return {"No elements", Verdict::Kind::Open, "Add bones and a control, then units that move them."};
    if (all == 0) return {"No units", Verdict::Kind::Open, "Add a unit: units move the rig's elements."};
    if (warned > 0) return {count_text(warned, "unit") + " with problems", Verdict::Kind::Bad, first};
    if (on == 0) return {"All units are off", Verdict::Kind::Open, "Switch one on in the list of units."};
    const std::string of = std::to_string(on) + " of " + count_text(all, "unit") + " switched on.";
    return {on == 1 ? "The unit ran" : "All units ran", Verdict::Kind::Good, of};
}

}  // namespace tendril::app
