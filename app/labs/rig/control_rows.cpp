// The value of the selected controls: fields for the active one, which set all of its kind.
#include <imgui.h>

#include "app/document/json_complete.hpp"
#include "app/document/units.hpp"
#include "app/labs/rig/panels.hpp"
#include "app/labs/rig/value_json.hpp"
#include "app/labs/rig/value_text.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

constexpr float max_control = 1e9f;

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
    /// `alike`: those selected that what is set is set on, this one among them.
    ControlFields(const RigPanel& panel, std::size_t element, const std::vector<std::size_t>& alike)
        : panel_(panel),
          control_(*panel.part.rig.definition().elements[element].control),
          value_(panel.part.state.controls[element]),
          alike_(alike) {}

    void rows() const {
        switch (control_.kind) {
            case rig::ControlKind::Bool: {
                bool on = std::get<bool>(value_);
                if (ImGui::Checkbox("on", &on)) set(on);
                explain("The value of this control: on or off, for the units that read it.");
                break;
            }
            case rig::ControlKind::Float: {
                float shown = static_cast<float>(std::get<double>(value_));
                if (number_field("value", shown, 0.005f, low().x, high().x, "%.3f")) set(number(shown));
                explain("The value of this control, for the units that read it.");
                break;
            }
            case rig::ControlKind::Vector2d:
                return pair(std::get<glm::dvec3>(value_));
            case rig::ControlKind::Position: {
                const auto& at = std::get<glm::dvec3>(value_);
                const glm::vec3 shown(at);
                glm::vec3 edited = shown;
                if (vector_field("position, m", edited, 0.01f, low(), high(), "%.3f"))
                    set(dpoint(edited_vector(at, shown, edited)));
                explain("Where the control is, in metres along each axis.");
                break;
            }
            case rig::ControlKind::Rotation: {
                glm::dquat rotation = std::get<glm::dquat>(value_);
                if (rotation_field(panel_, "rotation, degrees", rotation)) set(rotation_json(rotation));
                break;
            }
            case rig::ControlKind::Transform:
                if (const auto changed =
                        transform_fields(panel_, std::get<rig::Transform>(value_), low(), high()))
                    set(**changed);
                break;
        }
    }
    void limits() const {
        if (!control_.minimum && !control_.maximum) return;
        reading("limits", "%s", limits_text(control_).c_str());
        explain("A drag stops at them.");
    }

  private:
    glm::vec3 low() const { return end_of(control_.minimum, -max_control); }
    glm::vec3 high() const { return end_of(control_.maximum, max_control); }
    void set(Json value) const {
        value = touched(std::move(value), control_value_json(control_.kind, value_));
        panel_.edit("rig.control.set", {which(panel_.part, alike_), {"value", SharedJson(std::move(value))}});
    }
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
    const rig::Control& control_;
    const rig::Value& value_;
    const std::vector<std::size_t>& alike_;
};

/// Of all controls that are selected, whatever their kinds.
void reset_button(const RigPanel& panel) {
    const RigPart& part = panel.part;
    std::vector<std::size_t> controls;
    bool moved = false;
    for (const std::size_t each : part.selected.elements.all()) {
        const rig::Element& element = part.rig.definition().elements[each];
        if (!element.control) continue;
        controls.push_back(each);
        moved |= part.state.controls[each] != rig::rest_value(*element.control, element.initial);
    }
    if (controls.empty()) return;
    const bool several = part.selected.elements.several();
    if (row_button(
            "Reset", 2, moved,
            several ? "Sets the selected controls to their initial values" : "Sets it to its initial value"))
        panel.edit("rig.control.reset", {which(part, controls)});
    end_row();
}

}  // namespace

std::vector<std::size_t> selected_alike(const RigPart& part) {
    const std::vector<rig::Element>& elements = part.rig.definition().elements;
    const auto kind = [&](std::size_t at) {
        return elements[at].control ? std::optional(elements[at].control->kind) : std::nullopt;
    };
    std::vector<std::size_t> alike;
    for (const std::size_t each : part.selected.elements.all())
        if (kind(each) == kind(*part.selected.elements.active())) alike.push_back(each);
    return alike;
}

void scope_note(const RigPart& part, std::size_t alike, const std::string& what) {
    if (!part.selected.elements.several()) return;
    const std::string set = "What you set, you set on ";
    if (alike == part.selected.elements.all().size()) return note(set + "all of them.");
    note(alike == 1 ? set + "this one: no others are " + what + "."
                    : set + std::to_string(alike) + " of them: those that are " + what + ".");
}

void control_rows(const RigPanel& panel) {
    const std::size_t active = *panel.part.selected.elements.active();
    const std::optional<rig::Control>& control = panel.part.rig.definition().elements[active].control;
    ImGui::PushID("control");
    if (control) {
        const std::vector<std::size_t> alike = selected_alike(panel.part);
        const ControlFields fields(panel, active, alike);
        fields.rows();
        fields.limits();
        scope_note(panel.part, alike.size(), std::string(control_title(control->kind)) + "s");
    }
    reset_button(panel);
    ImGui::PopID();
}

}  // namespace tendril::app
