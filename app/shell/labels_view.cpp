#include "app/shell/labels_view.hpp"

#include <imgui.h>

#include "app/shell/theme.hpp"

namespace tendril::app {

void show_labels(const std::vector<Label>& labels, const Camera& camera, const Palette& palette, float scale) {
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    for (const Label& label : labels) {
        if (const auto at = camera.project(label.at)) {
            list->AddText({at->x + label.clearance * scale, at->y - 8.0f}, imgui_u32(palette.text), label.text.c_str());
        }
    }
}

}  // namespace tendril::app
