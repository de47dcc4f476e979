// The units in execution order, each with its switch, time and warning, and the inspector of one unit.
#include <imgui.h>
#include <algorithm>
#include <utility>

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/rig/panel.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/unit_inputs.hpp"
#include "app/labs/rig/values.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

/// "parent_constraint" becomes "parent constraint".
std::string operation_title(std::size_t index) {
    std::string title = rig::operation_name(index);
    std::replace(title.begin(), title.end(), '_', ' ');
    return title;
}

void title_row(const RigPanel& panel, const UnitRow& row, const std::vector<double>& times) {
    const rig::Unit& unit = *row.unit;
    const float em = ImGui::GetFontSize(), line = ImGui::GetTextLineHeight();
    if (row.inner) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 1.2f * em);
    switch_box(panel, unit);
    ImGui::SameLine(0.0f, 0.5f * em);
    const ImVec2 at = ImGui::GetCursorPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const bool selected = panel.part.selected.unit == unit.name;
    if (ImGui::Selectable("##row", selected, 0, {width, line})) select_unit(panel, selected ? "" : unit.name);
    const std::string operation = operation_title(unit.operation.index());
    if (ImGui::IsItemHovered())
        tooltip(unit.name + ": " + operation + '\n' +
                operation_help(rig::operation_name(unit.operation.index())));
    std::string time;
    if (!row.inner && row.top < times.size()) time = fixed_text(times[row.top], 1) + " \xC2\xB5s";
    const float time_width = time.empty() ? 0.0f : ImGui::CalcTextSize(time.c_str()).x + 0.5f * em;
    const float room = width - time_width;
    const std::string name = elided(unit.name, room);
    ImGui::SetCursorPos(at);
    ImGui::TextUnformatted(name.c_str());
    const float left = room - ImGui::CalcTextSize(name.c_str()).x - 0.6f * em;
    const bool says_more = unit.name != operation && unit.name != rig::operation_name(unit.operation.index());
    if (says_more && left > 2.5f * em) {
        ImGui::SameLine(0.0f, 0.6f * em);
        ImGui::TextDisabled("%s", elided(operation, left).c_str());
    }
    if (!time.empty()) {
        ImGui::SameLine(at.x + width - time_width + 0.5f * em);
        ImGui::TextDisabled("%s", time.c_str());
    }
}

void add_unit_menu(const RigPanel& panel) {
    const std::string loop = selected_loop(panel.part);
    const bool pressed =
        row_button("Add a unit", 1, true,
                   ("Choose a kind; the new unit runs last" + (loop.empty() ? "" : " in " + loop)).c_str());
    constexpr float width = 24.0f;  // em: room for the longest reason
    if (!begin_list_of_button("add unit", pressed, {.width = width * ImGui::GetFontSize(), .rows = 16}))
        return;
    for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i) {
        const UnitOffer offer = offered_unit(panel.part, i);
        if (!list_row(capitalised(operation_title(i)), false, offer.unit ? nullptr : offer.needs)) continue;
        ArgumentList arguments;
        for (const auto& [key, value] : (*offer.unit)->items()) arguments.push_back({key, SharedJson(value)});
        panel.edit("rig.unit.add", arguments);
    }
    end_list();
}

/// Index of the unit in its list, and the length of that list.
std::pair<int, int> place_of(const std::vector<UnitRow>& rows, const UnitRow& row) {
    int at = 0, count = 0;
    for (const UnitRow& each : rows) {
        if (each.inner != row.inner || (row.inner && each.top != row.top)) continue;
        if (each.at == row.at) at = count;
        ++count;
    }
    return {at, count};
}

void order_buttons(const RigPanel& panel, const std::vector<UnitRow>& rows) {
    const auto selected = unit_row(panel.part, panel.part.selected.unit);
    const auto [at, count] = selected ? place_of(rows, *selected) : std::pair(0, 0);
    const std::string& name = panel.part.selected.unit;
    if (row_button("Up", 3, selected && at > 0, "The selected unit runs earlier"))
        panel.edit("rig.unit.move", {{"name", name}, {"at", at - 1}});
    if (row_button("Down", 3, selected && at + 1 < count, "The selected unit runs later"))
        panel.edit("rig.unit.move", {{"name", name}, {"at", at + 1}});
    if (row_button("Remove", 3, selected.has_value(), "Removes the selected unit"))
        panel.edit("rig.unit.remove", {{"name", name}});
    end_row();
}

}  // namespace

void switch_box(const RigPanel& panel, const rig::Unit& unit) {
    bool on = unit.enabled;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.0f, 0.0f));
    if (ImGui::Checkbox("##on", &on)) panel.edit("rig.unit.enable", {{"name", unit.name}, {"on", on}});
    ImGui::PopStyleVar();
    if (ImGui::IsItemHovered()) tooltip(on ? "Runs; click to mute it" : "Muted; click to run it");
}

void warning_line(const RigPanel& panel, rig::Warning warning, float margin) {
    const std::string text = capitalised(rig::message(warning));
    if (text.empty()) return;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + margin);
    coloured_note("! " + text, panel.colours.limit);
}

void unit_list(const RigPanel& panel) {
    const std::vector<UnitRow> rows = unit_rows(panel.part);
    const std::vector<double> times =
        panel.workspace.clock.measured ? panel.runtime.microseconds(panel.part.rig) : std::vector<double>();
    const float line = ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
    constexpr float max_lines = 26.0f;
    // The list grows with its content up to a limit, then scrolls.
    const bool many = rows.size() > 20;
    const float top = ImGui::GetCursorPosY();
    if (many) ImGui::BeginChild("units", {0.0f, max_lines * line}, false);
    for (const UnitRow& row : rows) {
        const rig::Warning warning = panel.part.state->units[row.at].warning;
        const bool selected = panel.part.selected.unit == row.unit->name;
        if (many && !selected && warning == rig::Warning::None &&
            !ImGui::IsRectVisible({ImGui::GetContentRegionAvail().x, line})) {
            ImGui::Dummy({1.0f, ImGui::GetTextLineHeight()});  // same height as the row
            continue;
        }
        ImGui::PushID(static_cast<int>(row.at));
        title_row(panel, row, times);
        if (many && selected && std::exchange(panel.runtime.panel.unit, row.unit->name) != row.unit->name &&
            !ImGui::IsItemVisible())
            ImGui::SetScrollHereY(0.3f);
        if (row.unit->enabled) warning_line(panel, warning, (row.inner ? 2.6f : 1.4f) * ImGui::GetFontSize());
        ImGui::PopID();
    }
    if (many) ImGui::EndChild();
    if (rows.empty()) note("No units: bones do not move.");
    keep_room("units", top);  // the warnings come and go
    order_buttons(panel, rows);
    add_unit_menu(panel);
}

// The selected unit: its inputs, with fields for literals, and its outputs.

namespace {

constexpr float max_literal = 1e9f;

class Fields {
  public:
    Fields(const RigPanel& panel, const UnitRow& row) : panel_(panel), row_(row) {}

    void row(const UnitInput& input) {
        input_ = &input;
        if (!input.literal()) return source_row();
        if (input.takes_input()) {
            chooser(input.title, nullptr);
            ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
        }
        if (input.value)
            std::visit([&](const auto& literal) { literal_field(literal); }, *input.value);
        else if (input.is(FieldType::Choice))
            choice();
        else if (input.is(FieldType::Pair))
            range();
        else if (!input.is(FieldType::Struct))
            names();
        else if (input.field->holds<signal::Curve>())
            curve(*static_cast<const signal::Curve*>(input.at));
        else
            filter(*static_cast<const rig::TransformFilter*>(input.at));
    }

  private:
    void set(Json value) const {
        const Json arguments = with_input(*row_.unit, input_->path, std::move(value));
        ArgumentList list;
        for (const auto& [key, each] : arguments.items()) list.push_back({key, SharedJson(each)});
        panel_.edit("rig.unit.set", list);
    }

    std::string help() const {
        return input_help(rig::operation_name(row_.unit->operation.index()), input_->path);
    }

    /// The source, with the current value below it.
    void source_row() const {
        chooser(input_->title, &input_->from);
        if (input_->value)
            text_flush_right(elided(input_text(*input_, *input_->value), ImGui::GetContentRegionAvail().x),
                             true);
    }

    /// A list of alternatives, opened by a field that shows the current one, or by a button.
    void chooser(const std::string& title, const std::string* shown, std::size_t index = 0) const {
        const bool open = begin_list(title.c_str(), shown);
        if (!open && ImGui::IsItemHovered())
            tooltip(title + ": " +
                    (shown != nullptr ? *shown + ". Click to choose another\n" + help()
                                      : "click to take it from an element or a unit"));
        if (!open) return;
        const std::vector<InputOffer> offers = input_offers(panel_.part, row_, *input_, index);
        if (offers.empty()) note("No part of this rig has a value of this type.");
        for (const InputOffer& offer : offers)
            if (list_row(offer.title, offer.now) && !offer.now) set(*offer.value);
        end_list();
    }

    void choice() const {
        const Field& field = *input_->field;
        std::vector<const char*> names(field.choices.begin(), field.choices.end());
        int chosen = static_cast<int>(field.number(input_->at));
        if (choice_field(input_->title.c_str(), chosen, names.data(), static_cast<int>(names.size())))
            set(names[static_cast<std::size_t>(chosen)]);
        explain(help().c_str());
    }
    /// One checkbox per axis.
    void filter(rig::TransformFilter passes) const {
        bool changed = false;
        ImGui::TextDisabled("%s", "passes on each axis");
        const auto axes = [&](const char* name, std::array<bool, 3>& on) {
            ImGui::AlignTextToFramePadding();
            ImGui::TextDisabled("%s", name);
            for (int i = 0; i < 3; ++i) {
                ImGui::SameLine(ImGui::GetWindowContentRegionMin().x +
                                (5.5f + 3.2f * static_cast<float>(i)) * ImGui::GetFontSize());
                const std::string label = std::string(1, "xyz"[i]) + "##" + name;
                changed |= ImGui::Checkbox(label.c_str(), &on[static_cast<std::size_t>(i)]);
                explain(help().c_str());
            }
        };
        axes("translation", passes.translation);
        axes("rotation", passes.rotation);
        axes("scale", passes.scale);
        if (changed)
            set({{"translation", passes.translation},
                 {"rotation", passes.rotation},
                 {"scale", passes.scale}});
    }
    void range() const {
        const FieldValue now = input_->field->get(input_->at);
        for (std::size_t i = 0; i < 2; ++i) {
            float shown = static_cast<float>(now[i]);
            if (number_field((input_->title + (i == 0 ? " low" : " high")).c_str(), shown, 0.01f,
                             -max_literal, max_literal, "%.3f"))
                set(i == 0 ? Json{number(shown), now[1]} : Json{now[0], number(shown)});
            explain(help().c_str());
        }
    }
    void names() const {
        const std::string& title = input_->title;
        const std::vector<std::string> names = input_->names();
        if (input_->field->count == nullptr) return chooser(title, &names.front());
        const std::string one = one_of(title), another = "another";
        for (std::size_t i = 0; i < names.size(); ++i)
            chooser(names.size() > 1 ? one + ' ' + std::to_string(i + 1) : one, &names[i], i);
        chooser("add a " + one, &another, names.size());
    }
    void curve(signal::Curve edited) const {
        const double width = edited.source_max - edited.source_min;
        double at = -1.0;  // outside the graph
        for (const UnitInput& each : unit_inputs(panel_.part, panel_.now, *row_.unit))
            if (each.value && each.path == "/value")
                if (const auto* number = std::get_if<double>(&*each.value)) at = *number;
        at = width != 0.0 ? (at - edited.source_min) / width : 0.0;
        if (curve_editor("curve", edited, panel_.colours.accent, 11.0f, at)) set(save_fields(edited));
        note("Drag a key. Double-click adds one, right-click removes it.");
        const auto end = [&](const char* name, double& value, const char* what) {
            float shown = static_cast<float>(value);
            const bool changed = number_field(name, shown, 0.01f, -max_literal, max_literal, "%.3f");
            explain(what);
            if (!changed) return;
            value = static_cast<double>(shown);
            set(save_fields(edited));
        };
        end("from low", edited.source_min, "The value that is at the left end of the curve.");
        end("from high", edited.source_max, "The value that is at the right end of the curve.");
        end("to low", edited.target_min, "The result where the curve is at 0.");
        end("to high", edited.target_max, "The result where the curve is at 1.");
    }

    void literal_field(bool on) const {
        if (ImGui::Checkbox(input_->title.c_str(), &on)) set(on);
        explain(help().c_str());
    }
    void literal_field(double value) const {
        float shown = static_cast<float>(value);
        const std::string unit = input_->unit;
        const bool angle = unit == "\xC2\xB0";
        const std::string format = is_speed_limit(*input_) ? "%.1f" + unit
                                   : unit.empty()          ? "%.3f"
                                                           : "%.3f " + unit;
        const auto low = static_cast<float>(input_->field->range.low),
                   high = static_cast<float>(input_->field->range.high);
        const float step = high == 1.0f ? 0.005f : angle ? 0.5f : 0.01f;
        if (number_field(input_->title.c_str(), shown, step, low, high, format.c_str(),
                         is_speed_limit(*input_) ? "no limit" : nullptr))
            set(number(shown));
        explain(help().c_str());
    }
    void literal_field(const glm::dvec3& value) const {
        const glm::vec3 shown(value);
        glm::vec3 edited = shown;
        if (vector_field(input_->title.c_str(), edited, 0.01f, glm::vec3(-max_literal),
                         glm::vec3(max_literal), "%.3f"))
            set(dpoint(edited_vector(value, shown, edited)));
        explain((help() + (*input_->unit != '\0' ? std::string(" In ") + input_->unit + '.' : "")).c_str());
    }
    void literal_field(const glm::dquat& value) const {
        glm::dquat rotation = value;
        if (rotation_field(panel_, (input_->title + ", degrees").c_str(), rotation))
            set(dquaternion(rotation));
    }
    void literal_field(const rig::Transform& value) const {
        ImGui::TextDisabled("%s", input_->title.c_str());
        if (const auto changed =
                transform_fields(panel_, value, glm::vec3(-max_literal), glm::vec3(max_literal))) {
            Json whole = transform_json(value);
            whole.update(**changed);
            set(whole);
        }
    }

    const RigPanel& panel_;
    const UnitRow& row_;
    const UnitInput* input_ = nullptr;
};

}  // namespace

void unit_inspector(const RigPanel& panel) {
    const auto row = unit_row(panel.part, panel.part.selected.unit);
    if (!row) return;
    const PanelSection ids(elided("Unit: " + row->unit->name, ImGui::GetContentRegionAvail().x).c_str());
    // The warning replaces the note, in room for two lines, so that the fields do not move.
    const float top = ImGui::GetCursorPosY();
    const rig::Warning warning = panel.part.state->units[row->at].warning;
    if (row->unit->enabled && warning != rig::Warning::None)
        warning_line(panel, warning);
    else
        note(operation_title(row->unit->operation.index()) +
             (row->inner ? ", run on each element of its for-each" : "") +
             (row->unit->enabled ? "" : ", switched off"));
    keep_room("about", top, note_height(2));
    name_field(panel, "rig.unit.rename", row->unit->name, "Another name: units that use its outputs follow.");
    Fields fields(panel, *row);
    for (const UnitInput& input : unit_inputs(panel.part, panel.now, *row->unit)) {
        if (input.path == "/when" && row->unit->when == rig::Unit().when) continue;  // the switch shows it
        ImGui::PushID(input.path.c_str());
        fields.row(input);
        ImGui::PopID();
    }
    const std::vector<rig::Output> outputs = rig::outputs(row->unit->operation);
    for (std::size_t i = 0; i < outputs.size(); ++i)
        reading((std::string("gives ") + outputs[i].name).c_str(), "%s",
                output_text(row->unit->operation, panel.part.state->units[row->at].outputs[i]).c_str());
    if (row->inner) note("These are its outputs for the last element of the for-each.");
    if (row_button("Close", 2, true, "Deselects the unit")) select_unit(panel, "");
    end_row();
}

}  // namespace tendril::app
