#include "tests/app/support/tooltips.hpp"

#include <imgui.h>
#include <imgui_internal.h>  // which item is under the mouse, and which windows there are

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace tendril::test {
namespace {

/// Scroll bars, and the cross of a window, which mean the same everywhere.
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

/// The letter whose place in the font's picture this is; 0 for anything else.
ImWchar letter_of(const ImDrawVert& low, const ImDrawVert& high) {
    for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
        for (const ImFontGlyph& glyph : font->Glyphs)
            if (glyph.U0 == low.uv.x && glyph.V0 == low.uv.y && glyph.U1 == high.uv.x &&
                glyph.V1 == high.uv.y)
                return static_cast<ImWchar>(glyph.Codepoint);
    return 0;
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

void TooltipFinder::look(glm::vec2 at, TooltipSearch& found, std::vector<Silent>& silent) {
    const ImGuiID id = ImGui::GetCurrentContext()->HoveredId;
    if (id == 0 || of_a_window(id)) return;
    const bool is_new = found.items.insert(id).second;
    if (!tooltip_shown()) {
        if (is_new) silent.push_back({id, at});
        return;
    }
    // A plot tells what is under the mouse, where there is something.
    silent.erase(
        std::remove_if(silent.begin(), silent.end(), [&](const Silent& each) { return each.id == id; }),
        silent.end());
}

std::string TooltipFinder::text_at(glm::vec2 at) {
    struct Letter {
        ImWchar letter;
        float end;
    };
    std::map<float, Letter> letters;
    const ImDrawData* const data = ImGui::GetDrawData();
    for (int list = 0; list < data->CmdListsCount; ++list) {
        const ImVector<ImDrawVert>& corners = data->CmdLists[list]->VtxBuffer;
        for (int i = 0; i + 2 < corners.Size; ++i) {
            const float middle = 0.5f * (corners[i].pos.y + corners[i + 2].pos.y);
            if (middle < at.y - 5.0f || middle > at.y + 20.0f) continue;
            if (std::abs(corners[i].pos.x - at.x) > 250.0f) continue;  // in another panel
            if (const ImWchar letter = letter_of(corners[i], corners[i + 2]); letter != 0)
                letters[corners[i].pos.x] = {letter, corners[i + 2].pos.x};
        }
    }
    std::string text;
    float end = 0.0f;
    for (const auto& [begin, letter] : letters) {
        if (!text.empty() && begin - end > 2.5f) text += ' ';
        text += letter.letter < 128 ? static_cast<char>(letter.letter) : '?';
        end = letter.end;
    }
    return text.empty() ? "(no text, " + std::to_string(static_cast<int>(at.y)) + " pixels down)" : text;
}

}  // namespace tendril::test
