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

constexpr float most = 1e9f;

/// The limits of a control as a drag ends at them.
glm::vec3 end_of(const std::optional<glm::dvec3>& limit, float none) {
    return limit ? glm::vec3(*limit) : glm::vec3(none);
}

/// "-1.00 to 1.00", of the parts that the kind has.
std::string limits_text(const rig::Control& control) {
    const auto text = [&](const std::optional<glm::dvec3>& end) {
        if (!end) return std::string("none");
        if (control.kind == rig::ControlKind::Float) return fixed_text(end->x, 2);
        const std::string all = vector_text(*end);
        return control.kind == rig::ControlKind::Vector2d ? all.substr(0, all.rfind("  ")) : all;
    };
    return text(control.minimum) + " to " + text(control.maximum);
}

class ControlFields {
  public:
    ControlFields(const RigPanel& panel, const rig::Element& element)
        : panel_(panel), element_(element), control_(*element.control) {}

    void rows(const rig::Value& value) {
        switch (control_.kind) {
            case rig::ControlKind::Bool: {
                bool on = std::get<bool>(value);
                if (ImGui::Checkbox("on", &on)) panel_.edit("rig.control.set", arguments(on));
                explain("The value of this control: on or off, for the units that read it.");
                break;
            }
            case rig::ControlKind::Float: {
                float shown = static_cast<float>(std::get<double>(value));
                if (number_field("value", shown, 0.005f, low().x, high().x, "%.3f")) set(number(shown));
                explain("The value of this control, for the units that read it.");
                break;
            }
            case rig::ControlKind::Vector2d:
                return pair(std::get<glm::dvec3>(value));
            case rig::ControlKind::Position: {
                const auto& at = std::get<glm::dvec3>(value);
                const glm::vec3 shown(at);
                glm::vec3 edited = shown;
                if (vector_field("position, m", edited, 0.01f, low(), high(), "%.3f"))
                    set(dpoint(edited_vector(at, shown, edited)));
                explain("Where the control is, in metres along each axis.");
                break;
            }
            case rig::ControlKind::Rotation: {
                glm::dquat rotation = std::get<glm::dquat>(value);
                if (rotation_field(panel_, "rotation, degrees", rotation)) set(rotation_json(rotation));
                break;
            }
            case rig::ControlKind::Transform:
                if (const auto changed =
                        transform_fields(panel_, std::get<rig::Transform>(value), low(), high()))
                    panel_.edit("rig.control.set", {{"name", element_.name}, {"value", *changed}});
                break;
        }
    }
    void end_rows(const rig::Value& value) const {
        if (control_.minimum || control_.maximum) {
            reading("limits", "%s", limits_text(control_).c_str());
            explain("A drag stops at them.");
        }
        const rig::Value rest = rig::rest_value(control_, element_.initial);
        if (row_button("Reset", 2, !(value == rest), "Sets it to its initial value"))
            panel_.edit("rig.control.set", arguments(SharedJson(control_value_json(control_.kind, rest))));
        end_row();
    }

  private:
    glm::vec3 low() const { return end_of(control_.minimum, -most); }
    glm::vec3 high() const { return end_of(control_.maximum, most); }
    ArgumentList arguments(ArgumentValue value) const {
        return {{"name", element_.name}, {"value", std::move(value)}};
    }
    void set(Json value) const { panel_.edit("rig.control.set", arguments(SharedJson(std::move(value)))); }
    /// Along its two axes, each by its name.
    void pair(const glm::dvec3& value) const {
        for (int i = 0; i < 2; ++i) {
            float shown = static_cast<float>(value[i]);
            const std::string name =
                std::string("along ") + "xyz"[control_.axes[static_cast<std::size_t>(i)]];
            const bool changed = number_field(name.c_str(), shown, 0.005f, low()[i], high()[i], "%.3f m");
            explain("The value of this control along that axis.");
            if (!changed) continue;
            Json both{value.x, value.y};
            both[static_cast<std::size_t>(i)] = number(shown);
            set(std::move(both));
        }
    }

    const RigPanel& panel_;
    const rig::Element& element_;
    const rig::Control& control_;
};

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

void pending_rows(const RigPanel& panel, const std::string& name, rig::ElementId id) {
    const rig::Pending pending = panel.part.state.elements.pending(id);
    text_line(
        "pending", rig::name(pending),
        "An element stores a local and a global transform. What is written makes the other one pending, and "
        "for a global one those of all elements below it. It is worked out when something reads it.");
    if (row_button("Read it", 2, true,
                   "Works out what is pending here and on the way to the root, and says how much that was"))
        panel.emit("rig.read", {{"name", name}});
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
    if (vector_field("scale", edited, 0.01f, glm::vec3(-most), glm::vec3(most), "%.3f"))
        changed["scale"] = dpoint(edited_vector(transform.scale, by, edited));
    explain("By how much it is larger along X, Y and Z. 1 leaves its size; 0 is not allowed.");
    if (changed.empty()) return std::nullopt;
    return SharedJson(std::move(changed));
}

void element_inspector(const RigPanel& panel) {
    const auto found = panel.part.rig.element(panel.part.selected.element);
    section("Element");
    if (!found) return note("Nothing is selected. Click an element, in the list or in the picture.");
    const rig::Element& element = panel.part.rig.definition().elements[*found];
    text_line("name", element.name);
    text_line("kind", element.control ? control_title(element.control->kind) : rig::name(element.kind));
    if (!element.parent.empty()) text_line("parent", element.parent);
    if (!element.control) return;
    ImGui::PushID("control");
    ControlFields fields(panel, element);
    fields.rows(panel.part.state.controls[*found]);
    fields.end_rows(panel.part.state.controls[*found]);
    ImGui::PopID();
}

void pose_rows(const RigPanel& panel) {
    const auto found = panel.part.rig.element(panel.part.selected.element);
    if (!found) return;
    const rig::Element& element = panel.part.rig.definition().elements[*found];
    const rig::ElementId id = panel.part.rig.id(*found);
    section("Poses");
    ImGui::PushID("poses");
    pose_lines("local", *panel.now.known(id, rig::Space::Local), "Within its parent, after the last unit.");
    pose_lines("global", *panel.now.known(id, rig::Space::Global), "In the scene, after the last unit.");
    pose_lines("initial", *panel.now.known(id, rig::Space::Local, rig::Pose::Initial),
               "Within its parent, when it was added: the pose at rest.");
    pending_rows(panel, element.name, id);
    if (!element.control) {
        ImGui::TextUnformatted("Input pose, within its parent");
        explain("Every solve begins with it, before the first unit runs.");
        const rig::Transform input = *panel.now.known(id, rig::Space::Local, rig::Pose::Input);
        if (const auto changed = transform_fields(panel, input, glm::vec3(-most), glm::vec3(most)))
            panel.edit("rig.element.set", {{"name", element.name}, {"transform", *changed}});
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
