#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

#include "app/document/units.hpp"
#include "app/labs/chain/panels.hpp"
#include "app/labs/chain/shown.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

using Joints = std::vector<glm::vec3>;

/// Under the microscope a segment is read, not set: it is where the step has it.
void selected_in_step(const ChainPart& part, const Joints& joints, std::size_t i) {
    const ShownSegment shown = shown_segment(part, joints, i);
    reading("x", "%.3f m", static_cast<double>(shown.position.x));
    reading("y", "%.3f m", static_cast<double>(shown.position.y));
    reading("z", "%.3f m", static_cast<double>(shown.position.z));
    reading("length in this step", "%.3f m", static_cast<double>(shown.length));
    reading("to the target", "%.3f m", static_cast<double>(glm::distance(shown.position, part.target)));
}

void selection_rows(const ChainPart& part, const Joints& joints, Emit& emit) {
    section("Selection");
    if (!part.selected) {
        note("Nothing is selected.");
        return;
    }
    const std::size_t i = *part.selected;
    const glm::vec3 at = joints[i];
    const std::string end = end_name(part, i);
    reading(part.mode == ChainMode::Reach ? "joint" : "segment", "%zu%s", i,
            end.empty() ? "" : (" (" + end + ")").c_str());
    if (part.study.trace) return selected_in_step(part, joints, i);
    glm::vec3 to = at;
    if (point_field("at", to, 0.01f)) emit.continuously("chain.pull", {{"index", i}, {"to", to}});
    float length = part.chain.length(i);
    if (number_field("length", length, 0.01f, 0.0f, 1000.0f, "%.3f m")) {
        emit.continuously("chain.set_length", {{"index", i}, {"length", length}});
    }
    if (i == 0) note("The head's length ties nothing; it counts once something is inserted before it.");
    reading("to the target", "%.3f m", static_cast<double>(glm::distance(at, part.target)));
}

void chain_rows(const ChainPart& part, const Joints& joints) {
    section("Chain");
    const Chain& chain = part.chain;
    reading("segments", "%zu", chain.size());
    if (chain.empty()) return;
    reading("reach", "%.3f m", static_cast<double>(chain.reach()));
    const bool reaches = part.mode == ChainMode::Reach;  // "tip to target" stands in its report
    reading(reaches ? "root to target" : "head to target", "%.3f m",
            static_cast<double>(glm::distance(joints.front(), part.target)));
    if (!reaches) reading("tail to target", "%.3f m", static_cast<double>(shown_residual(part, joints)));
    float worst = 0.0f;
    for (std::size_t i = 1; i < joints.size(); ++i)
        worst = std::max(worst, shown_segment(part, joints, i).error);
    reading("worst error", "%s", si_text(static_cast<double>(worst), "m").c_str());
}

void number_cell(const char* format, float value) {
    char text[24];
    std::snprintf(text, sizeof text, format, static_cast<double>(value));
    if (std::string_view(text) == "-0.00") std::snprintf(text, sizeof text, "0.00");
    text_flush_right(text);
}

void segment_row(const ChainPart& part, const Joints& joints, std::size_t i, Emit& emit) {
    const ShownSegment segment = shown_segment(part, joints, i);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    char id[24];
    std::snprintf(id, sizeof id, "%zu", i);
    if (ImGui::Selectable(id, part.selected == i, ImGuiSelectableFlags_SpanAllColumns)) {
        emit("chain.select", {{"index", i}});
    }
    for (int axis = 0; axis < 3; ++axis) {
        ImGui::TableNextColumn();
        number_cell("%.2f", segment.position[axis]);
    }
    ImGui::TableNextColumn();
    number_cell("%.3f", segment.length);
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
    constexpr Column columns[] = {{"#", 0.7f}, {"x", 1.0f},       {"y", 1.0f},
                                  {"z", 1.0f}, {"length", 1.05f}, {"error", 1.4f}};
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
    const int selected = part.selected ? static_cast<int>(*part.selected) : -1;
    if (std::exchange(followed, selected) == selected || selected < 0) return;
    const float top = static_cast<float>(selected) * row_height;
    const float visible =
        ImGui::GetWindowHeight() - 2.0f * row_height;  // below the header, and the row itself
    if (top < ImGui::GetScrollY() || top > ImGui::GetScrollY() + visible)
        ImGui::SetScrollY(top - 0.5f * visible);
}

void segment_table(const ChainPart& part, const Joints& joints, Emit& emit) {
    section("Segments, in metres");
    ImGui::PushFont(small_font());
    const bool narrow = ImGui::GetContentRegionAvail().x < 16.0f * ImGui::GetFontSize();
    const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                  ImGuiTableFlags_NoPadOuterX |
                                  (narrow ? ImGuiTableFlags_ScrollX : ImGuiTableFlags_None);
    const float min_height = 8.0f * ImGui::GetTextLineHeightWithSpacing();
    const float height = std::max(min_height, ImGui::GetContentRegionAvail().y);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(3.0f, 2.0f));
    if (ImGui::BeginTable("segments", 6, flags, {0.0f, height})) {
        header_row(narrow);
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(part.chain.size()));
        while (clipper.Step()) {
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
                segment_row(part, joints, static_cast<std::size_t>(i), emit);
            }
        }
        follow_selection(part, clipper.ItemsHeight);
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

}  // namespace

void ChainLab::inspector(const Workspace& workspace, Emit& emit) const {
    const ChainPart& part = chain_part(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    if (part.study.trace) microscope_rows(part, colours, emit);
    if (part.study.race) race_rows(workspace, colours, emit);
    const Joints joints = shown_joints(part);
    if (part.mode == ChainMode::Reach) report_rows(part, joints, colours);
    selection_rows(part, joints, emit);
    if (part.mode == ChainMode::Reach) limit_rows(part, emit);
    chain_rows(part, joints);
    segment_table(part, joints, emit);
}

}  // namespace tendril::app
