#include "app/widgets/row_search.hpp"

#include <imgui.h>

#include <algorithm>

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

}  // namespace tendril::app
