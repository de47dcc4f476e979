#include "app/widgets/row_search.hpp"

#include <imgui.h>
#include <algorithm>
#include <string_view>

#include "app/widgets/number_entry.hpp"

namespace tendril::app {

RowSearch* row_search() {
    return number_editing().search;
}

void note_row_of(std::string_view command, std::string_view argument) {
    RowSearch* const search = row_search();
    if (search == nullptr || search->command != command) return;
    if (std::ranges::find(search->arguments, argument) == search->arguments.end()) return;
    search->found.insert(search->found.end(), search->inside.begin(), search->inside.end());
}

void note_text(const void* text, const char* label) {
    if (RowSearch* const search = row_search()) search->texts.emplace_back(text, ImGui::GetID(label));
}

SearchWindow::SearchWindow(RowSearch& search) {
    number_editing().search = &search;
    ImGui::SetNextWindowPos({-20000.0f, -20000.0f});
    ImGui::SetNextWindowSize({300.0f, 4000.0f});
    ImGui::Begin("search", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBackground);
}

SearchWindow::~SearchWindow() {
    ImGui::End();
    number_editing().search = nullptr;
}

namespace {

/// A key in the window's storage, independent of the id stack, which differs for the caller.
ImGuiID key_of(std::string_view title, char what) {
    ImGuiID hash = 2166136261u ^ static_cast<unsigned char>(what);
    for (const char each : title) hash = (hash ^ static_cast<unsigned char>(each)) * 16777619u;
    return hash;
}

/// An arrow in the middle of the window at height y: scroll down (1) or up (-1).
void draw_arrow(float y, float down, const ImVec4& colour) {
    const float size = 0.55f * ImGui::GetTextLineHeight();
    const float x = ImGui::GetWindowPos().x + 0.5f * ImGui::GetWindowWidth();
    ImDrawList* const list = ImGui::GetWindowDrawList();
    const ImVec2 a{x - size, y - 0.5f * down * size}, tip{x, y + 0.5f * down * size}, b{x + size, a.y};
    list->AddLine(a, tip, ImGui::ColorConvertFloat4ToU32(colour), 0.25f * size);
    list->AddLine(tip, b, ImGui::ColorConvertFloat4ToU32(colour), 0.25f * size);
}

}  // namespace

void note_section(const char* title) {
    ImGuiStorage* const storage = ImGui::GetStateStorage();
    storage->SetInt(key_of(title, 'f'), ImGui::GetFrameCount());
    storage->SetFloat(key_of(title, 'y'), ImGui::GetCursorPosY());
}

bool has_section(const char* title) {
    return ImGui::GetStateStorage()->GetInt(key_of(title, 'f'), -1) == ImGui::GetFrameCount();
}

void light_section(const char* title) {
    if (!has_section(title)) return;
    ImGuiStorage* const storage = ImGui::GetStateStorage();
    const float line = ImGui::GetTextLineHeight(), air = 0.25f * line;
    const ImVec2 window = ImGui::GetWindowPos();
    const float top = window.y - ImGui::GetScrollY() + storage->GetFloat(key_of(title, 'y'), 0.0f);
    const ImVec2 low{window.x + ImGui::GetWindowContentRegionMin().x - 0.5f * line, top - air};
    const ImVec2 high{window.x + ImGui::GetWindowContentRegionMax().x + 0.3f * line, top + line + 1.2f * air};
    ImDrawList* const list = ImGui::GetWindowDrawList();
    ImVec4 colour = ImGui::GetStyleColorVec4(ImGuiCol_CheckMark);
    const float bottom = window.y + ImGui::GetWindowHeight();
    if (low.y < window.y || high.y > bottom) {
        draw_arrow(high.y > bottom ? bottom - line : window.y + line, high.y > bottom ? 1.0f : -1.0f, colour);
        return;
    }
    colour.w = 0.16f;
    list->AddRectFilled(low, high, ImGui::ColorConvertFloat4ToU32(colour), 0.3f * line);
    colour.w = 0.9f;
    list->AddRect(low, high, ImGui::ColorConvertFloat4ToU32(colour), 0.3f * line, 0, 0.1f * line);
}

}  // namespace tendril::app
