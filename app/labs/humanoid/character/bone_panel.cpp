// The bone map: a row for each bone with its node and a bar that says how sure that is. A row that is clicked
// waits for a node, from the list or from a click on the figure.
#include <imgui.h>

#include "app/document/units.hpp"
#include "app/labs/humanoid/ik/chains.hpp"
#include "app/labs/humanoid/panels.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

ImU32 colour_of(glm::vec3 c, float alpha = 1.0f) {
    return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, alpha});
}

const std::string& node_name(const HumanoidPart& part, std::int32_t node) {
    return part.skeleton()[static_cast<std::size_t>(node)].name;
}

const char* sureness(double confidence) {
    return confidence >= 0.8 ? "sure" : confidence >= 0.5 ? "likely" : "doubtful";
}

/// As long as the match is sure; what is doubtful stands out.
void confidence_bar(const HumanoidPanel& panel, double confidence, ImVec2 at, float width, float height) {
    ImDrawList* const list = ImGui::GetWindowDrawList();
    list->AddRectFilled(at, {at.x + width, at.y + height}, colour_of(panel.colours.field), 1.5f);
    const glm::vec3 colour = confidence >= 0.8   ? panel.colours.tail
                             : confidence >= 0.5 ? panel.colours.selection
                                                 : panel.colours.limit;
    list->AddRectFilled(at, {at.x + width * static_cast<float>(confidence), at.y + height}, colour_of(colour),
                        1.5f);
}

void bone_tooltip(const HumanoidPart& part, Bone bone) {
    const humanoid::BoneMatch& match = (*part.map)[bone];
    std::string text = humanoid::name(bone);
    if (match.node >= 0)
        text += ": " + node_name(part, match.node) + "\n" + sureness(match.confidence) + ", " +
                fixed_text(100.0 * match.confidence, 0) + " %";
    else
        text +=
            humanoid::is_needed(bone) ? ": missing; the body solve needs it" : ": none; it can do without";
    if (!match.reasons.empty()) text += "\n" + match.reasons;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(26.0f * ImGui::GetFontSize());
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void bone_row(const HumanoidPanel& panel, Bone bone) {
    const humanoid::BoneMatch& match = (*panel.part.map)[bone];
    auto& waiting = panel.runtime.panel.bone;
    const float em = ImGui::GetFontSize(), line = ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos(), at = ImGui::GetCursorPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(static_cast<int>(bone));
    if (match.node >= 0 && panel.part.selection.has(static_cast<std::size_t>(match.node))) {
        const bool active = panel.part.selection.active() == static_cast<std::size_t>(match.node);
        ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + width, corner.y + line},
                                                  colour_of(panel.colours.selection, active ? 0.45f : 0.22f),
                                                  3.0f);
    }
    if (ImGui::Selectable("##row", waiting == bone, 0, {width, line})) {
        const bool more = ImGui::GetIO().KeyShift;
        if (!more) waiting = waiting == bone ? std::nullopt : std::optional(bone);
        if (match.node >= 0 && (more || waiting))
            panel.emit("humanoid.select", {{"node", node_name(panel.part, match.node)}, {"add", more}});
    }
    if (ImGui::IsItemHovered()) bone_tooltip(panel.part, bone);
    ImGui::PopID();
    const float bar = 2.0f * em, names = 7.2f * em;
    ImGui::SetCursorPos(at);
    ImGui::TextUnformatted(elided(humanoid::name(bone), std::min(names, width)).c_str());
    if (match.node >= 0) {
        ImGui::SetCursorPos({at.x + names, at.y});
        ImGui::TextDisabled(
            "%s", elided(node_name(panel.part, match.node), width - names - bar - 0.5f * em).c_str());
        confidence_bar(panel, match.confidence, {corner.x + width - bar, corner.y + 0.35f * line}, bar,
                       0.35f * line);
    } else {
        const bool needed = humanoid::is_needed(bone);
        ImGui::SetCursorPos({at.x + names, at.y});
        ImGui::PushStyleColor(ImGuiCol_Text,
                              colour_of(needed ? panel.colours.limit : panel.colours.text_dim));
        ImGui::TextUnformatted(needed ? "missing" : "none");
        ImGui::PopStyleColor();
    }
}

/// For the row that waits, a list of all nodes; always there, so that nothing below it moves.
void node_chooser(const HumanoidPanel& panel) {
    auto& waiting = panel.runtime.panel.bone;
    ImGui::BeginDisabled(!waiting);
    const std::int32_t now = waiting ? (*panel.part.map)[*waiting].node : -1;
    const std::string shown = !waiting ? "click a bone" : now < 0 ? "none" : node_name(panel.part, now);
    auto& typed = panel.runtime.panel.node;
    if (begin_search("node", &shown, typed)) {
        const auto pick = [&](const std::string& node) {
            panel.emit("humanoid.map", {{"bone", humanoid::name(*waiting)}, {"node", node}});
            waiting.reset();
        };
        if (search_row("none", now < 0, typed)) {
            pick("");
        } else {
            for (std::size_t i = 0; i < panel.part.skeleton().size() && waiting; ++i)
                if (search_row(panel.part.skeleton()[i].name, now == static_cast<std::int32_t>(i), typed))
                    pick(panel.part.skeleton()[i].name);
        }
        end_search();
    }
    ImGui::EndDisabled();
    explain("Which node of the character is the chosen bone. Type a part of its name to find it.");
}

}  // namespace

void bone_rows(const HumanoidPanel& panel) {
    if (!folding_section(panel.workspace, "Bones", panel.emit)) return;
    const std::string& why = panel.runtime.solvers.why_no_body(panel.part);
    if (!why.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, colour_of(panel.colours.limit));
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(("The body solve is off: " + why + ".").c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
    }
    node_chooser(panel);
    note(panel.runtime.panel.bone ? "Click a node of the figure, or pick it in the list."
                                  : "Click a row, then a node of the figure, to say which it is.");
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) bone_row(panel, static_cast<Bone>(i));
}

}  // namespace tendril::app
