#include "tests/app/support/tooltips.hpp"

#include <imgui.h>
#include <imgui_internal.h>  // the item under the mouse, and the windows

#include <algorithm>
#include <cctype>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tendril::test {
namespace {

/// Scroll bars and close buttons, which mean the same everywhere.
bool of_a_window(ImGuiID id) {
    for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
        if (!window->Active) continue;
        for (const ImGuiAxis axis : {ImGuiAxis_X, ImGuiAxis_Y})
            if (id == ImGui::GetWindowScrollbarID(window, axis)) return true;
        if (id == ImGui::GetIDWithSeed("#CLOSE", nullptr, window->ID)) return true;
    }
    return false;
}

bool tooltip_shown() {
    const auto& windows = ImGui::GetCurrentContext()->Windows;
    return std::any_of(windows.begin(), windows.end(), [](const ImGuiWindow* window) {
        return window->Active && (window->Flags & ImGuiWindowFlags_Tooltip) != 0;
    });
}

}  // namespace

glm::vec2 TooltipFinder::window_size() const {
    return window_->size();
}

void TooltipFinder::begin(glm::vec2 mouse) {
    const app::Event moved = app::MouseMove{mouse};
    input_.take(&moved);
    const glm::ivec2 size(window_->size().x, std::max(window_->size().y, static_cast<int>(panel_height_)));
    ui_.begin({size, size, 1.0f}, app::Theme::Dark, input_, &moved, true);
}

void TooltipFinder::begin_panel(glm::vec2 mouse) {
    begin(mouse);
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize({panel_width, panel_height_});
    ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
}

void TooltipFinder::end_panel() {
    ImGui::End();
    end();
}

void TooltipFinder::fit_panel() {
    const ImGuiWindow* const panel = ImGui::FindWindowByName("panel");
    panel_height_ = panel->ContentSize.y + 2.0f * panel->WindowPadding.y + 1.0f;
}

void TooltipFinder::begin_text() {
    ImGui::LogToClipboard();
}

std::string TooltipFinder::end_text() {
    ImGui::LogFinish();
    return ImGui::GetClipboardText();
}

std::string TooltipFinder::without_numbers(std::string text) {
    text.erase(std::remove_if(text.begin(), text.end(),
                              [](unsigned char c) { return std::isdigit(c) || c == '-' || c == '.'; }),
               text.end());
    return text;
}

std::vector<glm::vec2> TooltipFinder::places_on(const DrawnItem& item, const app::Rect& part) {
    const ImRect& seen = item.window->InnerClipRect;
    const glm::vec2 low = glm::max(glm::max(item.box.min, part.min), glm::vec2(seen.Min.x, seen.Min.y));
    const glm::vec2 high = glm::min(glm::min(item.box.max, part.max), glm::vec2(seen.Max.x, seen.Max.y));
    if (!(low.x < high.x && low.y < high.y) || of_a_window(item.id)) return {};
    std::vector<glm::vec2> places{0.5f * (low + high)};
    const glm::ivec2 steps = glm::clamp(glm::ivec2((high - low) / 14.0f), glm::ivec2(1), glm::ivec2(20));
    for (int y = 0; y < steps.y; ++y)
        for (int x = 0; x < steps.x; ++x)
            places.push_back(low + (high - low) * (glm::vec2(x, y) + 0.5f) / glm::vec2(steps));
    return places;
}

bool TooltipFinder::look(const DrawnItem& item, TooltipSearch& found,
                         std::map<unsigned, const DrawnItem*>& silent) {
    const ImGuiID hovered = ImGui::GetCurrentContext()->HoveredId;
    if (hovered != item.id) return found.items.count(item.id) != 0 && silent.count(item.id) == 0;
    found.items.insert(item.id);
    if (!tooltip_shown()) {
        silent.emplace(item.id, &item);
        return false;
    }
    silent.erase(item.id);
    return true;
}

std::string TooltipFinder::text_at(const FrameRecord& drawn, const DrawnItem& item) {
    const glm::vec2 at = 0.5f * (item.box.min + item.box.max);
    const DrawnText* nearest = nullptr;
    float least = FLT_MAX;
    for (const DrawnText& text : drawn.texts) {
        const float distance = glm::distance(at, glm::clamp(at, text.box.min, text.box.max));
        if (distance >= least) continue;
        least = distance;
        nearest = &text;
    }
    if (nearest != nullptr) return nearest->text;
    return "(no text, " + std::to_string(static_cast<int>(at.y)) + " pixels down)";
}

}  // namespace tendril::test
