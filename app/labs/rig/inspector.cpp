// What is selected in the Rig lab: an element with its poses, a unit with its inputs.
#include "app/labs/rig/panels.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "app/document/json_complete.hpp"
#include "app/document/units.hpp"
#include "app/labs/kit/incident_rows.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/value_json.hpp"
#include "app/labs/rig/value_text.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

constexpr float max_coordinate = 1e9f;

void text_line(const char* name, const std::string& value, const char* what = "") {
    ImGui::TextDisabled("%s", name);
    if (*what != '\0') explain(what);
    ImGui::SameLine();
    text_flush_right(elided(value, ImGui::GetContentRegionAvail().x));
}

/// Read only: translation, rotation, and the scale where there is one.
void pose_lines(const char* title, const rig::Transform& pose, const char* what) {
    text_line(title, vector_text(pose.translation, 3) + " m", what);
    text_line("", rotation_text(pose.rotation) + "\xC2\xB0");
    if (pose.scale != rig::Transform().scale) text_line("", "scale " + vector_text(pose.scale, 3));
}

void pending_rows(const RigPanel& panel, std::size_t element) {
    const Selection& selected = panel.part.selected.elements;
    const rig::Pending pending = panel.part.state.elements.pending(panel.part.rig.id(element));
    text_line(
        "pending", rig::name(pending),
        "An element stores a local and a global transform. What is written makes the other one pending, and "
        "for a global one those of all elements below it. It is worked out when something reads it.");
    if (row_button(selected.several() ? "Read them" : "Read it", 2, true,
                   "Works out what is pending here and on the way to the root, and says how much that was"))
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
    if (rotation_field(panel, "rotation, degrees", rotation)) changed["rotation"] = rotation_json(rotation);
    edited = by;
    if (vector_field("scale", edited, 0.01f, glm::vec3(-max_coordinate), glm::vec3(max_coordinate), "%.3f"))
        changed["scale"] = dpoint(edited_vector(transform.scale, by, edited));
    explain("By how much it is larger along X, Y and Z. 1 leaves its size; 0 is not allowed.");
    if (changed.empty()) return std::nullopt;
    return SharedJson(std::move(changed));
}

void element_inspector(const RigPanel& panel) {
    const Selection& selected = panel.part.selected.elements;
    section(selected.several() ? "Elements" : "Element");
    if (!selected.active())
        return note("Nothing is selected. Click an element, in the list or in the picture.");
    const rig::Element& element = panel.part.rig.definition().elements[*selected.active()];
    if (selected.several())
        note(count_text(selected.all().size(), "element") + ", " + element.name + " is shown");
    else
        text_line("name", element.name);
    text_line("kind", element.control ? control_title(element.control->kind) : rig::name(element.kind));
    if (!element.parent.empty()) text_line("parent", element.parent);
    control_rows(panel);
}

void pose_rows(const RigPanel& panel) {
    const auto found = panel.part.selected.elements.active();
    if (!found) return;
    const rig::Element& element = panel.part.rig.definition().elements[*found];
    const rig::ElementId id = panel.part.rig.id(*found);
    section("Poses");
    ImGui::PushID("poses");
    pose_lines("local", *panel.now.known(id, rig::Space::Local), "Within its parent, after the last unit.");
    pose_lines("global", *panel.now.known(id, rig::Space::Global), "In the scene, after the last unit.");
    pose_lines("initial", *panel.now.known(id, rig::Space::Local, rig::Pose::Initial),
               "Within its parent, when it was added: the pose at rest.");
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
    ImGui::PopID();
}

void RigLab::inspector(const Workspace& workspace, Emit& emit) const {
    const RigPanel panel = rig_panel(workspace, emit);
    show_verdict(rig_verdict(panel.part), panel.colours);
    unit_inspector(panel);
    element_inspector(panel);
    why_rows(panel);
    pose_rows(panel);
    incident_rows(workspace, panel.colours, emit);  // last: fields keep still while one is dragged to a limit
}

}  // namespace tendril::app
