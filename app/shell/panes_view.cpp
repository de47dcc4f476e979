#include "app/shell/panes_view.hpp"

#include <imgui.h>

#include <algorithm>

#include "app/shell/axis_gizmo.hpp"
#include "app/shell/theme.hpp"
#include "app/widgets/fonts.hpp"

namespace tendril::app {

void show_pane_titles(std::span<const Pane> panes, std::span<const PaneTitle> titles, const Palette& palette,
                      float scale) {
    if (panes.size() < 2) return;
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    const float inset = 10.0f * scale;
    float right = 0.0f;
    for (const Pane& pane : panes) right = std::max(right, pane.rect.max.x);
    for (std::size_t i = 0; i < std::min(panes.size(), titles.size()); ++i) {
        const Rect& rect = panes[i].rect;
        const PaneTitle& title = titles[i];
        list->AddRect({rect.min.x, rect.min.y}, {rect.max.x, rect.max.y}, imgui_u32(palette.bar), 0.0f, 0,
                      2.0f * scale);
        // The axis gizmo is in the top right corner of the whole view.
        const bool corner = rect.min.y == panes.front().rect.min.y && rect.max.x == right;
        const float axes = corner ? axis_gizmo_width(rect.size(), scale) : 0.0f;
        const float room = rect.size().x - 2.0f * inset - axes;
        ImVec2 at{rect.min.x + inset, rect.min.y + 0.7f * inset};
        const auto line = [&](const std::string& text, glm::vec3 colour) {
            const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
            if (at.y + size.y > rect.max.y) return;
            list->AddText(ImGui::GetFont(), ImGui::GetFontSize(), at, imgui_u32(colour), text.c_str(), nullptr,
                          room);
            at.y += size.y + 1.0f * scale;
        };
        ImGui::PushFont(heading_font());
        line(title.text, title.colour);
        ImGui::PopFont();
        ImGui::PushFont(small_font());
        if (ImGui::CalcTextSize(title.detail.c_str()).x < room) line(title.detail, palette.text_dim);
        ImGui::PopFont();
    }
}

void show_selection_box(const Rect& box, const Palette& palette, float scale) {
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    const ImVec2 low{box.min.x, box.min.y}, high{box.max.x, box.max.y};
    list->AddRectFilled(low, high, imgui_u32(palette.selection, 0.12f));
    list->AddRect(low, high, imgui_u32(palette.selection, 0.9f), 0.0f, 0, scale);
}

}  // namespace tendril::app
