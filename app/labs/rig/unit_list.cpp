// The units in the order in which they run, each with its switch, its time and its warning.
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/document/units.hpp"
#include "app/labs/rig/adding.hpp"
#include "app/labs/rig/input_help.hpp"
#include "app/labs/rig/panels.hpp"
#include "app/labs/rig/value_text.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

/// "parent_constraint" as "parent constraint".
std::string operation_title(std::size_t index) {
    std::string title = rig::operation_name(index);
    std::replace(title.begin(), title.end(), '_', ' ');
    return title;
}

void switch_box(const RigPanel& panel, const rig::Unit& unit) {
    bool on = unit.enabled;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.0f, 0.0f));
    if (ImGui::Checkbox("##on", &on)) panel.edit("rig.unit.enable", {{"name", unit.name}, {"on", on}});
    ImGui::PopStyleVar();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip(on ? "Runs; click to skip it" : "Skipped; click to run it");
}

/// Switch, name, operation, time.
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
        ImGui::SetTooltip("%s: %s\n%s", unit.name.c_str(), operation.c_str(),
                          operation_help(rig::operation_name(unit.operation.index())));
    std::string time;
    if (!row.inner && row.top < times.size()) time = fixed_text(times[row.top], 1) + " \xC2\xB5s";
    const float time_width = time.empty() ? 0.0f : ImGui::CalcTextSize(time.c_str()).x + 0.5f * em;
    const float room = width - time_width;
    const std::string name = elided(unit.name, room);
    ImGui::SetCursorPos(at);
    ImGui::TextUnformatted(name.c_str());
    const float left = room - ImGui::CalcTextSize(name.c_str()).x - 0.6f * em;
    if (operation != unit.name && left > 2.5f * em) {
        ImGui::SameLine(0.0f, 0.6f * em);
        ImGui::TextDisabled("%s", elided(operation, left).c_str());
    }
    if (!time.empty()) {
        ImGui::SameLine(at.x + width - time_width + 0.5f * em);
        ImGui::TextDisabled("%s", time.c_str());
    }
}

/// A line of a unit: what it reads or hands out, and what that is now; below it, where there is no room.
void live_line(const std::string& title, const std::string& from, const std::string& value, float margin) {
    const float gap = 0.6f * ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x - margin;
    const auto width_of = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + margin);
    ImGui::TextDisabled("%s", elided(title, 0.6f * width).c_str());
    ImGui::SameLine();
    const std::string both = from.empty() || value.empty() ? from + value : from + ": " + value;
    const float room = width - std::min(width_of(title), 0.6f * width) - gap;
    if (from.empty() || width_of(both) <= room) return text_flush_right(elided(both, room));
    text_flush_right(elided(from, room));
    if (!value.empty()) text_flush_right(elided(value, ImGui::GetContentRegionAvail().x));
}

std::string live_text(const UnitInput& input) {
    struct ToText {
        const UnitInput& input;
        std::string operator()(std::monostate) const { return {}; }
        std::string operator()(const rig::Value& value) const { return input_text(input, value); }
        std::string operator()(const InputChoice& choice) const { return choice.names[choice.chosen]; }
        std::string operator()(const InputFilter& filter) const {
            return filter.passes == rig::TransformFilter() ? "all pass" : "some do not pass";
        }
        std::string operator()(const InputRange& range) const {
            return fixed_text(range.low, 2) + " to " + fixed_text(range.high, 2);
        }
        std::string operator()(const InputNames& names) const {
            std::string text;
            for (const std::string& each : names.names) text += (text.empty() ? "" : ", ") + each;
            return text;
        }
        std::string operator()(const InputCurve& curve) const {
            return count_text(curve.curve.keys.size(), "key");
        }
    };
    return std::visit(ToText{input}, input.value);
}

void live_lines(const RigPanel& panel, const UnitRow& row) {
    const float margin = (row.inner ? 2.6f : 1.4f) * ImGui::GetFontSize();
    const rig::Unit usual;
    for (const UnitInput& input : unit_inputs(panel.part, panel.now, *row.unit)) {
        // Weight 1 and no condition are what one expects.
        if (input.path == "/weight" && row.unit->weight == usual.weight) continue;
        if (input.path == "/when" && row.unit->when == usual.when) continue;
        live_line(input.title, input.from, live_text(input), margin);
    }
    const std::vector<rig::Output> outputs = rig::outputs(row.unit->operation);
    const rig::UnitState& state = panel.part.state.units[row.at];
    for (std::size_t i = 0; i < outputs.size(); ++i)
        live_line(std::string("gives ") + outputs[i].name, "",
                  output_text(row.unit->operation, state.outputs[i]), margin);
}

void add_unit_menu(const RigPanel& panel) {
    if (row_button("Add a unit", 1, true, "A list of every kind of unit; the new one runs last"))
        ImGui::OpenPopup("add unit");
    if (!ImGui::BeginPopup("add unit")) return;
    close_popup_on_escape();
    for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i) {
        const UnitOffer offer = offered_unit(panel.part, i);
        std::string title = operation_title(i);
        title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
        if (!offer.unit) title += std::string(": needs ") + offer.needs;
        if (!ImGui::MenuItem(title.c_str(), nullptr, false, offer.unit.has_value())) continue;
        ArgumentList arguments;
        for (const auto& [key, value] : (*offer.unit)->items()) arguments.push_back({key, SharedJson(value)});
        panel.edit("rig.unit.add", arguments);
    }
    ImGui::EndPopup();
}

/// Its place in the list that it is in, and how long that is.
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
    if (row_button("Up", 3, selected && at > 0, "Moves the selected unit up: it runs earlier"))
        panel.edit("rig.unit.move", {{"name", name}, {"at", at - 1}});
    if (row_button("Down", 3, selected && at + 1 < count, "Moves it down: it runs later"))
        panel.edit("rig.unit.move", {{"name", name}, {"at", at + 1}});
    if (row_button("Remove", 3, selected.has_value(), "Removes the selected unit"))
        panel.edit("rig.unit.remove", {{"name", name}});
    end_row();
}

}  // namespace

void warning_line(const RigPanel& panel, rig::Warning warning, float margin) {
    std::string text = rig::message(warning);
    if (text.empty()) return;
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    const glm::vec3 c = panel.colours.limit;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + margin);
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(c.r, c.g, c.b, 1.0f));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(("! " + text).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void unit_list(const RigPanel& panel) {
    const std::vector<UnitRow> rows = unit_rows(panel.part);
    const std::vector<double> times =
        panel.workspace.clock.measured ? panel.runtime.microseconds(panel.part.rig) : std::vector<double>();
    const float line = ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
    constexpr float max_lines = 26.0f;
    // As high as what is in it, as long as that is not too much: then it scrolls.
    const bool many = rows.size() > 20;
    if (many) ImGui::BeginChild("units", {0.0f, max_lines * line}, false);
    for (const UnitRow& row : rows) {
        const rig::Warning warning = panel.part.state.units[row.at].warning;
        const bool selected = panel.part.selected.unit == row.unit->name;
        if (many && !selected && warning == rig::Warning::None &&
            !ImGui::IsRectVisible({ImGui::GetContentRegionAvail().x, line})) {
            ImGui::Dummy({1.0f, ImGui::GetTextLineHeight()});  // as high as the row
            continue;
        }
        ImGui::PushID(static_cast<int>(row.at));
        title_row(panel, row, times);
        if (many && selected && std::exchange(panel.runtime.panel.unit, row.unit->name) != row.unit->name &&
            !ImGui::IsItemVisible())
            ImGui::SetScrollHereY(0.3f);
        if (row.unit->enabled) warning_line(panel, warning, (row.inner ? 2.6f : 1.4f) * ImGui::GetFontSize());
        if (selected) live_lines(panel, row);
        ImGui::PopID();
    }
    if (many) ImGui::EndChild();
    if (rows.empty()) note("No units: bones stay where they are.");
    order_buttons(panel, rows);
    add_unit_menu(panel);
}

}  // namespace tendril::app
