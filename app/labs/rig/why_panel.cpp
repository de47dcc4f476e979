// Why is this bone here? What each unit added to the selected element, in order.
#include <imgui.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "app/document/units.hpp"
#include "app/labs/rig/panels.hpp"
#include "app/labs/rig/value_text.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

/// "12.3 mm", "1.20 m": lengths of rigs are between the two.
std::string length_text(double metres) {
    return metres < 1.0 ? fixed_text(1000.0 * metres, 1) + " mm" : fixed_text(metres, 2) + " m";
}

std::string added_text(const rig::Contribution& step) {
    std::string text =
        length_text(step.metres) + "  " + fixed_text(glm::degrees(step.radians), 1) + "\xC2\xB0";
    return step.before.scale == step.after.scale ? text : text + ", scale";
}

/// By more than what shows: rounding is no touch.
bool touched(const rig::Contribution& step) {
    constexpr double enough = 1e-7;
    const glm::dvec3 scale = glm::abs(step.after.scale - step.before.scale);
    return step.metres > enough || step.radians > enough || std::max({scale.x, scale.y, scale.z}) > enough;
}

void unit_line(const RigPanel& panel, const rig::Unit& unit, const rig::Contribution& step) {
    ImGui::PushID(unit.name.c_str());
    bool on = unit.enabled;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.0f, 0.0f));
    if (ImGui::Checkbox("##on", &on)) panel.edit("rig.unit.enable", {{"name", unit.name}, {"on", on}});
    ImGui::PopStyleVar();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip(on ? "Click to mute this unit" : "Muted; click to run it");
    ImGui::SameLine(0.0f, 0.5f * ImGui::GetFontSize());
    const std::string added = !on ? "muted" : touched(step) ? added_text(step) : "nothing";
    const float room =
        ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(added.c_str()).x - 0.6f * ImGui::GetFontSize();
    text_elided(unit.name, std::max(room, 3.0f * ImGui::GetFontSize()), !on || !touched(step));
    ImGui::SameLine();
    text_flush_right(added, !on || !touched(step));
    if (ImGui::IsItemHovered()) {
        const std::string change = value_text(step.change);
        ImGui::SetTooltip("Adds %s in its own space.\nThen it is at %s.", change.c_str(),
                          value_text(step.after).c_str());
    }
    ImGui::PopID();
}

void place_line(const char* title, const rig::Transform& pose) {
    ImGui::TextDisabled("%s", title);
    ImGui::SameLine();
    text_flush_right(vector_text(pose.translation, 3));
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", value_text(pose).c_str());
}

}  // namespace

void why_rows(const RigPanel& panel) {
    const auto element = panel.part.selected.elements.active();
    if (!element) return;
    const rig::Element& selected = panel.part.rig.definition().elements[*element];
    const std::string title =
        selected.kind == rig::ElementKind::Bone ? "Why is this bone here?" : "Why is it here?";
    section(title.c_str());
    ImGui::PushID("why");
    const rig::Explanation& why = panel.runtime.explanation(panel.workspace, *element);
    const std::vector<rig::Unit>& units = panel.part.rig.definition().units;
    place_line("before any unit", why.input);
    std::size_t untouched = 0;
    bool& all = panel.runtime.panel.all_units;
    for (std::size_t i = 0; i < why.units.size(); ++i) {
        const bool idle = units[i].enabled && !touched(why.units[i]);
        untouched += idle;
        if (!idle || all) unit_line(panel, units[i], why.units[i]);
    }
    if (untouched > 0) {
        const std::string count = count_text(untouched, "unit") + " did not touch it";
        if (row_button((all ? "Hide what did nothing" : count).c_str(), 1, true,
                       all ? "Lists only the units that touched it" : "Lists them too"))
            all = !all;
        end_row();
    }
    place_line("where it is", why.result);
    ImGui::PopID();
}

}  // namespace tendril::app
