#include "tests/app/support/tooltips.hpp"

#include <imgui.h>

namespace tendril::test {

void TooltipFinder::begin_panel(glm::vec2 mouse) {
    const app::Event moved = app::MouseMove{mouse};
    input_.take(&moved);
    ui_.begin({window_->size(), window_->size(), 1.0f}, app::Theme::Dark, input_, &moved, true);
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize({panel_width, 300.0f});
    ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
}

void TooltipFinder::end_panel() {
    ImGui::End();
    ui_.end();
}

void TooltipFinder::begin_text() {
    ImGui::LogToClipboard();
}

std::string TooltipFinder::end_text() {
    ImGui::LogFinish();
    return ImGui::GetClipboardText();
}

}  // namespace tendril::test
