#include "app/shell/labels_view.hpp"

#include <imgui.h>
#include <algorithm>
#include <glm/common.hpp>
#include <string>
#include <vector>

#include "app/shell/gizmo_view.hpp"
#include "app/shell/ui.hpp"
#include "app/view/labels.hpp"
#include "app/widgets/fonts.hpp"

namespace tendril::app {

namespace {

/// The rectangles of the scene's balls, in pixels, for labels to avoid.
std::vector<Rect> balls_of(const DrawList& drawn, const Camera& camera) {
    std::vector<Rect> boxes;
    for (const Stroke& stroke : drawn.strokes) {
        if (stroke.a != stroke.b || stroke.unit != Unit::Pixels || stroke.shade != Shade::Lit) continue;
        if (const auto at = camera.project(stroke.a))
            boxes.push_back({*at - stroke.radius_a, *at + stroke.radius_a});
    }
    return boxes;
}

}  // namespace

void show_labels(const DrawList& drawn, const Camera& camera, const Palette& palette, float scale,
                 std::span<const Rect> overlays) {
    if (drawn.labels.empty()) return;
    ImGui::PushFont(small_font());
    const ImVec2 padding{4.0f * scale, 1.0f * scale};
    std::vector<LabelRequest> requests;
    std::vector<const Label*> asked;
    for (const Label& label : drawn.labels) {
        const auto at = camera.project(label.at);
        if (!at) continue;
        const ImVec2 size = ImGui::CalcTextSize(label.text.c_str());
        requests.push_back({.at = *at,
                            .size = {size.x + 2.0f * padding.x, size.y + 2.0f * padding.y},
                            .clearance = label.clearance,
                            .rank = label.rank});
        asked.push_back(&label);
    }
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    std::vector<Rect> covers = balls_of(drawn, camera);
    covers.insert(covers.end(), overlays.begin(), overlays.end());
    for (const PlacedLabel& placed : place_labels(requests, camera.viewport(), 2.0f, covers)) {
        const Label& label = *asked[placed.request];
        const Rect& box = placed.box;
        // A background plate keeps the text legible.
        list->AddRectFilled({box.min.x, box.min.y}, {box.max.x, box.max.y}, imgui_u32(palette.bar, 0.62f),
                            3.0f * scale);
        list->AddText({box.min.x + padding.x, box.min.y + padding.y}, imgui_u32(label.colour),
                      label.text.c_str());
    }
    ImGui::PopFont();
}

namespace {

/// The legend's columns: names, then numbers. Widths in pixels, in the current font.
struct LegendColumns {
    std::vector<float> widths;
    float apart = 0.0f;

    LegendColumns(std::span<const LegendRow> rows, const Rect& view, float scale) : apart(14.0f * scale) {
        const auto take = [&](std::size_t column, const std::string& text) {
            if (column >= widths.size()) widths.resize(column + 1, 0.0f);
            widths[column] = std::max(widths[column], ImGui::CalcTextSize(text.c_str()).x);
        };
        for (const LegendRow& row : rows) {
            take(0, row.name);
            for (std::size_t i = 0; i < row.numbers.size(); ++i) take(i + 1, row.numbers[i]);
            for (std::size_t i = 0; i < row.widest.size(); ++i) take(i + 1, row.widest[i]);
        }
        // With numbers that are too wide, it would cover the scene.
        if (!widths.empty() && total() > 0.55f * view.size().x) widths.resize(1);
    }
    float total() const {
        float sum = -apart;
        for (const float width : widths) sum += width + apart;
        return sum;
    }
};

}  // namespace

Rect legend_box(std::span<const LegendRow> rows, const Rect& view, float scale, ViewCorner corner) {
    const bool small = view.size().y < 300.0f * scale || view.size().x < 260.0f * scale;
    if (rows.empty() || small) return {view.min, view.min};  // the picture takes precedence
    ImGui::PushFont(small_font());
    const float wide = LegendColumns(rows, view, scale).total();
    const float height = 1.35f * ImGui::GetFontSize() * static_cast<float>(rows.size());
    ImGui::PopFont();
    const glm::vec2 size{30.0f * scale + wide, height};
    constexpr float most = 0.2f;  // of the view
    if (size.x * size.y > most * view.size().x * view.size().y) return {view.min, view.min};
    const glm::vec2 low_end = view.min + glm::vec2(0.0f, 12.0f * scale),
                    high_end = view.max - size - glm::vec2(12.0f * scale);
    const glm::vec2 at = glm::mix(low_end, high_end, corner);
    return {at, at + size};
}

Rect show_legend(std::span<const LegendRow> rows, const Rect& view, const Palette& palette, float scale,
                 ViewCorner corner) {
    const Rect box = legend_box(rows, view, scale, corner);
    if (box.size().y <= 0.0f) return box;
    ImGui::PushFont(small_font());
    const LegendColumns columns(rows, view, scale);
    const float line = 1.35f * ImGui::GetFontSize();
    float y = box.min.y;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    // A plain background keeps axes and grid lines out of the words.
    const float edge = 6.0f * scale;
    list->AddRectFilled({box.min.x + edge, box.min.y - edge}, {box.max.x + edge, box.max.y + 0.5f * edge},
                        imgui_u32(palette.background_bottom, 0.82f), edge);
    for (const LegendRow& row : rows) {
        const ImVec2 centre{box.min.x + 18.0f * scale, y + 0.5f * ImGui::GetFontSize()};
        if (row.ring)
            list->AddCircle(centre, 3.6f * scale, imgui_u32(row.colour), 20, 1.5f * scale);
        else
            list->AddCircleFilled(centre, 4.0f * scale, imgui_u32(row.colour), 20);
        float x = centre.x + 12.0f * scale;
        const glm::vec3 ink = row.numbers.empty() ? palette.text_dim : palette.text;
        for (std::size_t i = 0; i < std::min(columns.widths.size(), row.numbers.size() + 1); ++i) {
            const std::string& text = i == 0 ? row.name : row.numbers[i - 1];
            list->AddText({x, y}, imgui_u32(ink), text.c_str());
            x += columns.widths[i] + columns.apart;
        }
        y += line;
    }
    ImGui::PopFont();
    return box;
}

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
        ImGui::PushFont(heading_font());
        const ImVec2 name = ImGui::CalcTextSize(title.text.c_str(), nullptr, false, room);
        ImGui::PopFont();
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
