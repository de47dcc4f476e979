#include "app/widgets/more.hpp"

#include <imgui.h>

#include <utility>

#include "app/widgets/icons.hpp"
#include "app/widgets/row_search.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

void MoreRows::add(std::string label, RowOf of, bool changed, std::function<void()> draw) {
    rows_.push_back({std::move(label), std::move(of), std::move(draw)});
    changed_ += changed ? 1 : 0;
}

std::string MoreRows::title() const {
    return changed_ == 0 ? "More" : "More (" + std::to_string(changed_) + " changed)";
}

bool MoreRows::head(bool open) const {
    std::string inside;
    for (const Row& row : rows_)
        if (!row.label.empty()) inside += (inside.empty() ? "" : ", ") + row.label;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeight();
    const std::string shown = title();
    const float mark = 0.9f * line, width = mark + ImGui::CalcTextSize(shown.c_str()).x;
    ImGui::PushID("more");
    const bool clicked = ImGui::InvisibleButton("head", {width, 1.2f * line});
    ImGui::PopID();
    const bool hovered = ImGui::IsItemHovered();
    if (hovered) tooltip(open ? "Click folds these rows" : inside);
    const ImU32 colour = ImGui::GetColorU32(hovered ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    draw_icon(ImGui::GetWindowDrawList(), open ? Icon::ChevronDown : Icon::ChevronRight,
              {at.x + 0.35f * line, at.y + 0.6f * line}, 1.1f * line, colour);
    const ImVec2 below = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({at.x + mark, at.y + 0.1f * line});
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(shown.c_str());
    ImGui::PopStyleColor();
    ImGui::SetCursorScreenPos(below);
    return clicked;
}

void MoreRows::draw() const {
    for (const Row& row : rows_) {
        for (const std::string& argument : row.of.arguments) note_row_of(row.of.command, argument);
        row.draw();
    }
}

}  // namespace tendril::app
