#include "app/shell/labels_view.hpp"

#include <imgui.h>

#include "app/shell/theme.hpp"
#include "app/view/labels.hpp"
#include "app/widgets/fonts.hpp"

namespace tendril::app {

namespace {

/// The rectangles of the picture's balls, in pixels, which labels should avoid.
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
    const std::vector<Label>& labels = drawn.labels;
    if (labels.empty()) return;
    ImGui::PushFont(small_font());
    const ImVec2 padding{4.0f * scale, 1.0f * scale};
    std::vector<LabelRequest> requests;
    std::vector<const Label*> asked;
    for (const Label& label : labels) {
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

}  // namespace tendril::app
