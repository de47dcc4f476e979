#include "app/shell/panes_view.hpp"

#include <imgui.h>

#include <algorithm>

#include "app/shell/axis_gizmo.hpp"
#include "app/shell/theme.hpp"
#include "app/widgets/fonts.hpp"

namespace tendril::app {

void show_pane_titles(std::span<const Pane> panes, std::span<const PaneTitle> titles, const Palette& palette,
                      float scale, bool has_axes) {
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
        const bool beside = has_axes && rect.min.y == panes.front().rect.min.y && rect.max.x == right;
        const float axes = beside ? axis_gizmo_width(rect.size(), scale) : 0.0f;
        const float room = rect.size().x - 2.0f * inset - axes;
        const ImVec2 corner{rect.min.x + inset, rect.min.y + 0.7f * inset};
        const auto size_of = [&](const std::string& text, ImFont* font) {
            ImGui::PushFont(font);
            const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
            ImGui::PopFont();
            return size;
        };
        const ImVec2 name = size_of(title.text, heading_font());
        if (corner.y + name.y > rect.max.y) continue;
        const float below = corner.y + name.y + 1.0f * scale;
        ImGui::PushFont(small_font());
        const float wide = ImGui::CalcTextSize(title.detail.c_str()).x, high = ImGui::GetFontSize();
        const bool detail = !title.detail.empty() && wide < room && below + high <= rect.max.y;
        // A plain background, like the legend's.
        const float edge = 0.5f * inset;
        list->AddRectFilled({corner.x - edge, corner.y - edge},
                            {corner.x + std::max(name.x, detail ? wide : 0.0f) + edge,
                             (detail ? below + high : corner.y + name.y) + edge},
                            imgui_u32(palette.background_bottom, 0.6f), edge);
        if (detail) list->AddText({corner.x, below}, imgui_u32(palette.text), title.detail.c_str());
        ImGui::PopFont();
        ImGui::PushFont(heading_font());
        list->AddText(ImGui::GetFont(), ImGui::GetFontSize(), corner, imgui_u32(title.colour),
                      title.text.c_str(), nullptr, room);
        ImGui::PopFont();
    }
}

void show_selection_box(const Rect& box, const Palette& palette, float scale) {
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    const ImVec2 low{box.min.x, box.min.y}, high{box.max.x, box.max.y};
    list->AddRectFilled(low, high, imgui_u32(palette.selection, 0.12f));
    list->AddRect(low, high, imgui_u32(palette.selection, 0.9f), 0.0f, 0, scale);
}

void show_stroke(glm::vec2 from, glm::vec2 to, const Palette& palette, float scale) {
    ImGui::GetBackgroundDrawList()->AddLine({from.x, from.y}, {to.x, to.y}, imgui_u32(palette.limit, 1.0f),
                                            2.0f * scale);
}

}  // namespace tendril::app
