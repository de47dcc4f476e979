#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <utility>

#include "app/document/units.hpp"
#include "app/labs/chain/panels.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/labs/kit/incident_rows.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

using Joints = std::vector<glm::vec3>;

void chain_rows(const ShownChain& shown, const Joints& joints) {
    section("Chain");
    const ChainPart& part = shown.part;
    const Chain& chain = part.chain;
    reading("size", "%s, %s", count_text(chain.size(), "joint").c_str(),
            count_text(chain.empty() ? 0 : chain.size() - 1, "bone").c_str());
    if (chain.empty()) return;
    reading("reach", "%.3f m", static_cast<double>(chain.reach()));
    const bool reaches = part.mode == ChainMode::Reach;  // "tip to target" stands in its report
    reading(reaches ? "root to target" : "head to target", "%.3f m",
            static_cast<double>(glm::distance(joints.front(), part.target)));
    if (!reaches) reading("tail to target", "%.3f m", static_cast<double>(shown_residual(part, joints)));
    reading("worst error", "%s", si_text(static_cast<double>(worst_error(shown, joints)), "m").c_str());
}

void joint_row(const ShownChain& shown, const Joints& joints, std::size_t i, Emit& emit) {
    const ShownSegment segment = shown_segment(shown, joints, i);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    char id[24];
    std::snprintf(id, sizeof id, "%zu", i);
    if (ImGui::Selectable(id, shown.part.selection.has(i), ImGuiSelectableFlags_SpanAllColumns)) {
        emit("chain.select", {{"index", i}, {"add", ImGui::GetIO().KeyShift}});
    }
    if (ImGui::IsItemHovered())
        tooltip(i == 0 ? "Click selects the first joint, Shift+click adds it"
                       : "Click selects this joint. bone: the length of the bone that leads to it; "
                         "error: how far that is from what it should be");
    for (int axis = 0; axis < 3; ++axis) {
        ImGui::TableNextColumn();
        text_flush_right(fixed_text(static_cast<double>(segment.position[axis]), 2));
    }
    ImGui::TableNextColumn();
    text_flush_right(fixed_text(static_cast<double>(segment.length), 3));
    ImGui::TableNextColumn();
    text_flush_right(si_text(static_cast<double>(segment.error), "m"));
}

/// `fixed`: columns as wide as their numbers, to be scrolled sideways, where the panel is too narrow for
/// them.
void header_row(bool fixed) {
    struct Column {
        const char* name;
        float share;
    };
    constexpr Column columns[] = {{"#", 0.7f}, {"x", 1.0f},     {"y", 1.0f},
                                  {"z", 1.0f}, {"bone", 1.05f}, {"error", 1.4f}};
    for (const Column& column : columns) {
        const float width = fixed ? 3.6f * column.share * ImGui::GetFontSize() : column.share;
        ImGui::TableSetupColumn(column.name,
                                fixed ? ImGuiTableColumnFlags_WidthFixed : ImGuiTableColumnFlags_WidthStretch,
                                width);
    }
    ImGui::TableSetupScrollFreeze(fixed ? 1 : 0, 1);
    ImGui::TableNextRow();
    for (const Column& column : columns) {
        ImGui::TableNextColumn();
        if (column.name[0] == '#') {
            ImGui::TextDisabled("%s", column.name);
        } else {
            text_flush_right(column.name, true);
        }
    }
}

/// Within the table: brings a row that was selected elsewhere into view, once.
void follow_selection(const ChainPart& part, float row_height) {
    int& followed = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("followed"), -1);
    const int selected = part.selection.active() ? static_cast<int>(*part.selection.active()) : -1;
    if (std::exchange(followed, selected) == selected || selected < 0) return;
    const float top = static_cast<float>(selected) * row_height;
    const float visible =
        ImGui::GetWindowHeight() - 2.0f * row_height;  // below the header, and the row itself
    if (top < ImGui::GetScrollY() || top > ImGui::GetScrollY() + visible)
        ImGui::SetScrollY(top - 0.5f * visible);
}

void joint_table(const ShownChain& shown, const Joints& joints, Emit& emit) {
    ImGui::PushFont(small_font());
    const bool narrow = ImGui::GetContentRegionAvail().x < 16.0f * ImGui::GetFontSize();
    const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                  ImGuiTableFlags_NoPadOuterX |
                                  (narrow ? ImGuiTableFlags_ScrollX : ImGuiTableFlags_None);
    const float min_height = 8.0f * ImGui::GetTextLineHeightWithSpacing();
    const float height = std::max(min_height, ImGui::GetContentRegionAvail().y);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(3.0f, 2.0f));
    if (ImGui::BeginTable("joints", 6, flags, {0.0f, height})) {
        header_row(narrow);
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(joints.size()));
        while (clipper.Step()) {
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
                joint_row(shown, joints, static_cast<std::size_t>(i), emit);
            }
        }
        follow_selection(shown.part, clipper.ItemsHeight);
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

}  // namespace

void ChainLab::inspector(const Workspace& workspace, Emit& emit) const {
    const ShownChain shown = shown_chain(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    const bool reaches = shown.part.mode == ChainMode::Reach;
    if (shown.trace) microscope_rows(shown, colours, emit);
    if (shown.race) race_rows(shown, colours, emit);
    const Joints joints = shown_joints(shown);
    report_rows(shown, joints, colours);
    incident_rows(workspace, colours, emit);
    selection_rows(shown, joints, emit);
    if (reaches) limit_rows(shown.part, emit);
    chain_rows(shown, joints);
    if (folding_section(workspace, "Joints, in metres", emit, false)) joint_table(shown, joints, emit);
}

}  // namespace tendril::app
