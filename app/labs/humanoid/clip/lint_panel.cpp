// What the lint has found in the clip, each with its cure, and where maps and clips go to.
#include <imgui.h>

#include <algorithm>

#include "app/document/units.hpp"
#include "app/labs/humanoid/panels.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

using humanoid::Finding;

constexpr std::size_t max_rows = 20;

const char* fault_title(humanoid::Fault fault) {
    constexpr const char* titles[] = {"skates",    "floats",         "sinks",
                                      "knee pops", "key flips sign", "beyond its limit",
                                      "jumps",     "wrong size",     "lies on its side"};
    return titles[static_cast<std::size_t>(fault)];
}

std::string amount(const Finding& finding) {
    const std::string unit = finding.unit;
    const double value = finding.amount;
    const std::string number = fixed_text(value, std::abs(value) < 9.5 ? 1 : 0);
    return unit == "deg" ? number + "°" : number + (unit == "times" ? " x" : " " + unit);
}

/// The node's name; nothing for the whole figure.
std::string node_of(const HumanoidPanel& panel, const Finding& finding) {
    return finding.node < 0 ? std::string()
                            : panel.part.skeleton()[static_cast<std::size_t>(finding.node)].name;
}

void go_to_finding(const HumanoidPanel& panel, const Finding& finding) {
    panel.emit("humanoid.clip", {{"time", finding.time}, {"play", false}});
    if (finding.node >= 0) panel.emit("humanoid.select", {{"node", node_of(panel, finding)}});
}

void cure(const HumanoidPanel& panel, const Finding& finding) {
    ArgumentList arguments{{"kind", humanoid::name(finding.fault)}};
    if (finding.node >= 0) arguments.push_back({"node", node_of(panel, finding)});
    if (finding.fault != humanoid::Fault::SignFlip) arguments.push_back({"frame", finding.frame});
    panel.emit("humanoid.cure", arguments);
}

/// What is wrong and by how much; below, where, and the button that mends it.
void finding_row(const HumanoidPanel& panel, const Finding& finding, int id) {
    const float em = ImGui::GetFontSize(), line = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float mend =
        finding.has_cure ? ImGui::CalcTextSize("Mend").x + 2.0f * ImGui::GetStyle().FramePadding.x : 0.0f;
    ImGui::PushID(id);
    if (ImGui::Selectable("##finding", false, ImGuiSelectableFlags_AllowItemOverlap, {width, 2.2f * line}))
        go_to_finding(panel, finding);
    explain(finding.text.c_str());
    const ImVec2 after = ImGui::GetCursorPos();
    const std::string value = amount(finding);
    ImGui::SetCursorPos(at);
    ImGui::TextUnformatted(fault_title(finding.fault));
    ImGui::SetCursorPos({at.x + width - ImGui::CalcTextSize(value.c_str()).x, at.y});
    ImGui::TextUnformatted(value.c_str());
    std::string where = "frame " + std::to_string(finding.frame);
    if (finding.node >= 0) where += ", " + node_of(panel, finding);
    ImGui::SetCursorPos({at.x, at.y + 1.1f * line});
    ImGui::TextDisabled("%s", elided(where, width - mend - 0.4f * em).c_str());
    if (finding.has_cure) {
        ImGui::SetCursorPos({at.x + width - mend, at.y + 1.1f * line});
        if (ImGui::SmallButton("Mend")) cure(panel, finding);
        explain("Changes the keys around it; the motion stays as it is elsewhere. Undo takes it back.");
    }
    ImGui::SetCursorPos(after);
    ImGui::PopID();
}

}  // namespace

void lint_rows(const HumanoidPanel& panel) {
    if (!folding_section(panel.workspace, "Motion lint", panel.emit)) return;
    if (!panel.part.clip()) return note("Choose a clip to see what is wrong with it.");
    const humanoid::LintReport* report = panel.runtime.lint.report(panel.part);
    if (!report) {
        if (row_button("Judge this clip", 1, true, "It is long: that takes some seconds"))
            panel.runtime.lint.judge(panel.part);
        end_row();
        return;
    }
    const std::vector<Finding>& findings = report->findings;
    if (findings.empty()) return note("Nothing was found.");
    note(std::to_string(findings.size()) + (findings.size() == 1 ? " finding" : " findings") + ", at " +
         fixed_text(report->rate, report->rate == std::floor(report->rate) ? 0 : 2) + " frames a second");
    for (std::size_t i = 0; i < std::min(findings.size(), max_rows); ++i)
        finding_row(panel, findings[i], static_cast<int>(i));
    if (findings.size() > max_rows) note("and " + std::to_string(findings.size() - max_rows) + " more");
}

void export_rows(const HumanoidPanel& panel) {
    if (!folding_section(panel.workspace, "Export", panel.emit)) return;
    if (panel.part.loaded->clips().empty()) return note("The character has no clips.");
    std::string& path = panel.runtime.panel.export_to;
    text_field("write to", path, "walk.glb");
    explain("A .gltf, .glb or .bvh file: the chosen clip, or the first, with all that IK does to it.");
    if (row_button("Export clip", 1, !path.empty(), "An existing file is replaced"))
        panel.emit("humanoid.export", {{"path", path}});
    end_row();
}

void map_rows(const HumanoidPanel& panel) {
    auto& state = panel.runtime.panel;
    text_field("map file", state.map_file, "bones.json");
    explain(
        "A file of this bone map, to save to or load from: it suits every character with the same node "
        "names.");
    if (row_button("Save map", 2, !state.map_file.empty(), "To the file; an existing one is replaced"))
        panel.emit("humanoid.map.save", {{"path", state.map_file}});
    if (row_button("Load map", 2, !state.map_file.empty(), "From the file"))
        panel.emit("humanoid.map.load", {{"path", state.map_file}});
    end_row();
}

}  // namespace tendril::app
