// The element tree, which draws only the rows in view, and the fields for selected controls.
#include <imgui.h>
#include <algorithm>
#include <string_view>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/rig/panel.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/values.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

struct Row {
    std::size_t element;
    int depth;
};

/// Depth first; with a filter, only matching rows, without indentation.
std::vector<Row> rows_of(const RigPart& part, const rig::Hierarchy& tree, std::string_view filter) {
    const std::vector<rig::Element>& elements = part.rig.definition().elements;
    std::vector<Row> rows;
    if (!filter.empty()) {
        for (std::size_t i = 0; i < elements.size(); ++i)
            if (contains_text(elements[i].name, filter)) rows.push_back({i, 0});
        return rows;
    }
    std::vector<std::size_t> at(elements.size());
    std::vector<int> depth(elements.size());
    for (std::size_t i = 0; i < elements.size(); ++i) at[part.rig.id(i).index] = i;
    for (rig::ElementId top = tree.first_child({}); top; top = tree.next_sibling(top))
        for (rig::ElementId each = top; each; each = tree.next_depth_first(each, top)) {
            const rig::ElementId parent = tree.parent(each);
            const std::size_t i = at[each.index];
            depth[i] = parent ? depth[at[parent.index]] + 1 : 0;
            rows.push_back({i, depth[i]});
        }
    return rows;
}

/// Bones are diamonds, nulls crosses, controls rings.
void draw_kind(rig::ElementKind kind, ImVec2 centre, float size, const Palette& colours) {
    const glm::vec3 c = kind == rig::ElementKind::Control ? colours.target : colours.text_dim;
    const ImU32 colour = imgui_u32(c);
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float r = 0.5f * size, thin = 0.3f * size;
    if (kind == rig::ElementKind::Bone)
        list->AddQuadFilled({centre.x - r, centre.y}, {centre.x - thin * 0.4f, centre.y - thin},
                            {centre.x + r, centre.y}, {centre.x - thin * 0.4f, centre.y + thin}, colour);
    if (kind == rig::ElementKind::Control) list->AddCircle(centre, 0.8f * r, colour, 16, 1.6f);
    if (kind == rig::ElementKind::Null) {
        list->AddLine({centre.x - r, centre.y}, {centre.x + r, centre.y}, colour, 1.4f);
        list->AddLine({centre.x, centre.y - r}, {centre.x, centre.y + r}, colour, 1.4f);
    }
}

/// The value of a control; for other elements the local translation.
std::string short_text(const RigPart& part, const rig::Hierarchy& now, std::size_t i) {
    const std::optional<rig::Control>& control = part.rig.definition().elements[i].control;
    if (!control) return vector_text(now.known(part.rig.id(i), rig::Space::Local)->translation, 1);
    const rig::Value& value = part.state->controls[i];
    if (control->kind == rig::ControlKind::Vector2d) {
        const auto& pair = std::get<glm::dvec3>(value);
        const std::string text = vector_text(pair, 1);
        return text.substr(0, text.rfind("  "));
    }
    if (const auto* pose = std::get_if<rig::Transform>(&value)) return vector_text(pose->translation, 1);
    if (const auto* rotation = std::get_if<glm::dquat>(&value))
        return vector_text(euler_degrees(*rotation), 0) + "\xC2\xB0";
    if (const auto* vector = std::get_if<glm::dvec3>(&value)) return vector_text(*vector, 1);
    return value_text(value);
}

void row_tooltip(const RigPart& part, std::size_t i) {
    const rig::Element& element = part.rig.definition().elements[i];
    std::string text = element.name + ": ";
    text += element.control ? control_title(element.control->kind) : rig::name(element.kind);
    if (!element.parent.empty()) text += ", child of " + element.parent;
    tooltip(text + "\nShift+click adds it to the selection, or takes it out.");
}

/// Distance between rows, pixels.
float row_height() {
    return 1.25f * ImGui::GetTextLineHeight();
}

/// `highlighted`: selected by the filter.
void draw_row(const RigPanel& panel, const Row& row, bool highlighted) {
    const rig::Element& element = panel.part.rig.definition().elements[row.element];
    const float line = ImGui::GetTextLineHeight(), em = ImGui::GetFontSize();
    const RigSelection& selected = panel.part.selected;
    const ImVec2 corner = ImGui::GetCursorScreenPos(), at = ImGui::GetCursorPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(static_cast<int>(row.element));
    ImVec4 colour = ImGui::GetStyleColorVec4(ImGuiCol_Header);
    if (selected.elements.active() != row.element) colour.w *= 0.5f;
    if (highlighted) colour = ImGui::GetStyleColorVec4(ImGuiCol_HeaderHovered);
    ImGui::PushStyleColor(ImGuiCol_Header, colour);
    if (ImGui::Selectable("##row", highlighted || selected.elements.has(row.element), 0, {width, line})) {
        if (ImGui::GetIO().KeyShift)
            panel.emit("rig.select", {{"element", element.name}, {"add", true}});
        else
            select_element(panel, selected.only_element() == row.element ? "" : element.name);
    }
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) row_tooltip(panel.part, row.element);
    ImGui::PopID();
    const float indent = 0.7f * em * static_cast<float>(std::min(row.depth, 6));
    draw_kind(element.kind, {corner.x + indent + 0.5f * em, corner.y + 0.5f * line}, 0.75f * em,
              panel.colours);
    // The name takes precedence over the value.
    const std::string value = short_text(panel.part, panel.now, row.element);
    const float from = at.x + indent + 1.2f * em, end = at.x + width;
    const float value_width = ImGui::CalcTextSize(value.c_str()).x;
    const std::string name = elided(element.name, end - from);
    ImGui::SetCursorPos({from, at.y});
    ImGui::TextUnformatted(name.c_str());
    if (from + ImGui::CalcTextSize(name.c_str()).x + 0.6f * em > end - value_width) return;
    ImGui::SameLine(end - value_width);
    ImGui::TextDisabled("%s", value.c_str());
}

/// Scrolls to a row, unless it is in view.
void show_row(int row) {
    const float top = row_height() * static_cast<float>(row);
    const float from = ImGui::GetScrollY(), height = ImGui::GetWindowHeight();
    if (top < from || top + row_height() > from + height) ImGui::SetScrollY(top - 0.5f * height);
}

/// Scrolls once to an element that was selected elsewhere.
void show_selected(const RigPanel& panel, const std::vector<Row>& rows) {
    std::string& shown = panel.runtime.panel.shown;
    const std::string selected = panel.part.selected_element();
    if (shown == selected) return;
    shown = selected;
    const auto element = panel.part.selected.elements.active();
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const Row& each) { return element && each.element == *element; });
    if (row == rows.end()) return;
    show_row(static_cast<int>(row - rows.begin()));
}

void add_element_menu(const RigPanel& panel) {
    const bool pressed =
        row_button("Add", 3, true, "A bone, a null or a control, below the selected element");
    if (begin_list_of_button("add element", pressed)) {
        const auto add = [&](const char* title, const char* kind, const char* control) {
            if (!list_row(title, false)) return;
            const std::string parent = panel.part.selected_element();
            const std::string name = free_element_name(panel.part, *control != '\0' ? "control" : kind);
            ArgumentList arguments{{"name", name}, {"kind", kind}};
            if (!parent.empty()) arguments.push_back({"parent", parent});
            if (*control != '\0') arguments.push_back({"control", control});
            arguments.push_back({"local", SharedJson(Json{{"translation", {0.0, 0.3, 0.0}}})});
            panel.edit("rig.element.add", arguments);
            select_element(panel, name);
        };
        add("Bone", "bone", "");
        add("Null", "null", "");
        for (const auto kind :
             {rig::ControlKind::Transform, rig::ControlKind::Position, rig::ControlKind::Rotation,
              rig::ControlKind::Float, rig::ControlKind::Bool, rig::ControlKind::Vector2d}) {
            add(capitalised(control_title(kind)).c_str(), "control", rig::name(kind));
        }
        const std::string parent = panel.part.selected_element();
        note(parent.empty() ? "In the scene" : "Below " + parent);
        end_list();
    }
}

}  // namespace

void element_tree(const RigPanel& panel) {
    // Above the list, because they change its length.
    add_element_menu(panel);
    const Selection& selected = panel.part.selected.elements;
    if (row_button(
            "Mirror", 3, panel.part.selected.only_element().has_value(),
            "Copies the selected element, all below it and the units that move them to the other side of its "
            "parent, across X"))
        panel.edit("rig.element.mirror", {{"name", panel.part.selected_element()}});
    if (row_button("Remove", 3, !selected.empty(),
                   selected.several() ? "Removes the selected elements" : "Removes the selected element"))
        panel.edit("rig.element.remove", {which(panel.part, selected.all())});
    end_row();
    auto& filter = panel.runtime.panel.filter;
    const std::size_t count = panel.part.state->controls.size();
    constexpr std::size_t many = 12;  // a shorter list needs no filter
    if (count > many) {
        search_line("##filter", "Filter by name", filter);
        if (!ImGui::IsItemActive() && !filter.entered) filter.at = -1;
        explain("Lists only elements whose names contain this. Up, Down and Enter choose one.");
    } else {
        filter = {};
    }
    const std::vector<Row> rows = rows_of(panel.part, panel.now, filter.text.data());
    filter.hits = static_cast<int>(rows.size());
    const bool highlights = filter.at >= 0 && filter.at < filter.hits;
    if (highlights && filter.entered)
        select_element(
            panel,
            panel.part.rig.definition().elements[rows[static_cast<std::size_t>(filter.at)].element].name);
    const float shown = std::clamp(static_cast<float>(rows.size()), 1.0f, 10.5f);
    ImGui::BeginChild("elements", {0.0f, shown * row_height() + 2.0f}, false);
    const ImVec2 spacing(ImGui::GetStyle().ItemSpacing.x, row_height() - ImGui::GetTextLineHeight());
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, spacing);
    show_selected(panel, rows);
    if (highlights && filter.moved) show_row(filter.at);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()), row_height());
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            draw_row(panel, rows[static_cast<std::size_t>(i)], i == filter.at);
    ImGui::PopStyleVar();
    ImGui::EndChild();
    if (count == 0) note("No elements.");
    if (count > 0 && rows.empty()) note("No element's name contains this.");
}

// Fields for the active control. Editing sets all selected controls of its kind.

namespace {

constexpr float max_control = 1e9f;

/// The limits, which a drag cannot pass.
glm::vec3 end_of(const std::optional<glm::dvec3>& limit, float none) {
    return limit ? glm::vec3(*limit) : glm::vec3(none);
}

/// "-1.00 to 1.00", with the components of the control's kind.
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
    /// `alike`: the selected elements that an edit sets, including this one.
    ControlFields(const RigPanel& panel, std::size_t element, const std::vector<std::size_t>& alike)
        : panel_(panel),
          control_(*panel.part.rig.definition().elements[element].control),
          value_(panel.part.state->controls[element]),
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
                explain("The control's position, in metres along each axis.");
                break;
            }
            case rig::ControlKind::Rotation: {
                glm::dquat rotation = std::get<glm::dquat>(value_);
                if (rotation_field(panel_, "rotation, degrees", rotation)) set(dquaternion(rotation));
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
        explain("A drag stops at these limits.");
    }
    /// A switch for each end, and the end itself. A new end starts at the control's value.
    void edit_limits() const {
        edit_limit("minimum", control_.minimum, low());
        edit_limit("maximum", control_.maximum, high());
    }
    bool is_limited() const {
        return control_.kind != rig::ControlKind::Rotation && control_.kind != rig::ControlKind::Bool;
    }

  private:
    void edit_limit(const char* name, const std::optional<glm::dvec3>& limit, const glm::vec3& end) const {
        bool on = limit.has_value();
        const auto set_end = [&](Json value) {
            panel_.edit("rig.control.limits",
                        {which(panel_.part, alike_), {name, SharedJson(std::move(value))}});
        };
        const auto in_kind = [&](const glm::dvec3& at) {
            if (control_.kind == rig::ControlKind::Float) return Json(at.x);
            return control_.kind == rig::ControlKind::Vector2d ? Json{at.x, at.y} : dpoint(at);
        };
        if (ImGui::Checkbox(name, &on)) set_end(on ? in_kind(here()) : Json(nullptr));
        explain("How far the control goes at this end.");
        if (!limit) return;
        glm::vec3 edited = end;
        const std::string field = std::string(name) + " at";
        const bool changed =
            control_.kind == rig::ControlKind::Float
                ? number_field(field.c_str(), edited.x, 0.005f, -max_control, max_control, "%.3f")
                : vector_field(field.c_str(), edited, 0.01f, glm::vec3(-max_control), glm::vec3(max_control),
                               "%.3f");
        if (changed) set_end(in_kind(edited_vector(*limit, end, edited)));
        explain("A drag stops here.");
    }
    glm::dvec3 here() const {
        if (const auto* number = std::get_if<double>(&value_)) return glm::dvec3(*number, 0.0, 0.0);
        if (const auto* whole = std::get_if<rig::Transform>(&value_)) return whole->translation;
        return std::get<glm::dvec3>(value_);
    }
    glm::vec3 low() const { return end_of(control_.minimum, -max_control); }
    glm::vec3 high() const { return end_of(control_.maximum, max_control); }
    void set(Json value) const {
        value = touched(std::move(value), control_value_json(control_.kind, value_));
        panel_.edit("rig.control.set", {which(panel_.part, alike_), {"value", SharedJson(std::move(value))}});
    }
    /// One field per axis, named after it.
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

/// Resets all selected controls of any kind.
void reset_button(const RigPanel& panel) {
    const RigPart& part = panel.part;
    std::vector<std::size_t> controls;
    bool moved = false;
    for (const std::size_t each : part.selected.elements.all()) {
        const rig::Element& element = part.rig.definition().elements[each];
        if (!element.control) continue;
        controls.push_back(each);
        moved |= part.state->controls[each] != rig::rest_value(*element.control, element.initial);
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
    const std::string set = "Changes apply to ";
    if (alike == part.selected.elements.all().size()) return note(set + "all of them.");
    note(alike == 1 ? set + "this one only: no others are " + what + "."
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
        MoreRows more;
        if (fields.is_limited())
            more.add("limits", {"rig.control.limits", {"minimum", "maximum"}}, false,
                     [&fields] { fields.edit_limits(); });
        more_rows(panel.workspace, "Element", more, panel.emit);
        scope_note(panel.part, alike.size(), std::string(control_title(control->kind)) + "s");
    }
    reset_button(panel);
    ImGui::PopID();
}

}  // namespace tendril::app
