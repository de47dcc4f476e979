
#include <imgui.h>
#include <imgui_internal.h>  // the window under the mouse, and closing popups from outside

#include <algorithm>
#include <cctype>
#include <utility>

#include "app/widgets/fields.hpp"
#include "app/widgets/number_entry.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

OpenList& open_list() {
    return number_editing().list;
}

void note_opener() {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    open_list().opener_min = {low.x, low.y};
    open_list().opener_max = {high.x, high.y};
}

float list_width(const ListRoom& room) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float rows = room.width + style.ScrollbarSize + 2.0f * style.WindowPadding.x;
    return room.width > 0.0f ? rows : 20.0f * ImGui::GetFontSize();
}

void constrain_list(const ListRoom& room) {
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowSizeConstraints({std::min(list_width(room), 40.0f * em), 0.0f},
                                        {40.0f * em, 30.0f * em});
}

/// A square of that colour in a box of a row, at its right end.
void draw_swatch(ImDrawList& list, ImVec2 low, ImVec2 high, glm::vec3 colour) {
    const float size = 0.6f * ImGui::GetFontSize(), middle = 0.5f * (low.y + high.y);
    list.AddRectFilled({high.x - 1.4f * size, middle - 0.5f * size},
                       {high.x - 0.4f * size, middle + 0.5f * size},
                       ImGui::GetColorU32({colour.r, colour.g, colour.b, 1.0f}), 0.2f * size);
}

/// The line to type into stays above the scrolling rows.
void begin_rows(const ListRoom& room, bool in_field) {
    OpenList& list = open_list();
    if (ImGui::IsWindowAppearing()) {
        list.typed = {};
        list.in_field = in_field;
        ImGui::SetKeyboardFocusHere();
    }
    if (!search_line("##typed", "Search", list.typed)) close_popup_on_escape();
    ImGui::BeginChild("rows", {0.0f, static_cast<float>(room.rows) * ImGui::GetTextLineHeightWithSpacing()});
}

}  // namespace

bool contains_text(std::string_view text, std::string_view part) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

bool search_line(const char* id, const char* hint, SearchText& typed) {
    const int last = std::exchange(typed.hits, 0) - 1;
    typed.rows = typed.found = 0;
    const bool was_empty = typed.empty();
    ImGui::SetNextItemWidth(-1.0f);
    typed.entered = ImGui::InputTextWithHint(id, hint, typed.text.data(), typed.text.size(),
                                             ImGuiInputTextFlags_EnterReturnsTrue);
    const int before = typed.at;
    const bool edited = ImGui::IsItemEdited();
    if (edited) typed.at = typed.empty() ? -1 : 0;
    if (ImGui::IsItemActive()) {
        if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_DownArrow))) ++typed.at;
        if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow))) typed.at = std::max(0, typed.at - 1);
        if (!edited) typed.at = std::min(typed.at, last);
    }
    typed.moved = typed.at != before;
    const bool cleared = ImGui::IsItemDeactivated() && escape_pressed() && !was_empty;
    if (cleared) {
        typed.text[0] = '\0';
        typed.at = -1;
    }
    if (cleared || (typed.entered && typed.at < 0)) ImGui::SetKeyboardFocusHere(-1);
    return cleared;
}

bool begin_list(const char* name, const std::string* shown, ListRoom room) {
    std::string id = std::string("##") + name + " list", preview;  // beside a field of that name
    if (shown != nullptr) {
        id = begin_row(name);
        if (room.after > 0.0f) ImGui::SetNextItemWidth(-room.after);
        const float buttons = room.swatch ? 2.0f : 1.0f;  // the arrow, and a swatch before it
        preview = elided(*shown, ImGui::CalcItemWidth() - buttons * ImGui::GetFrameHeight() -
                                     ImGui::GetStyle().FramePadding.x);
    }
    const bool cut = shown != nullptr && preview != *shown;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = shown != nullptr ? ImGui::CalcItemWidth() : ImGui::GetFrameHeight();
    ImDrawList& panel = *ImGui::GetWindowDrawList();
    constrain_list(room);
    const bool open = ImGui::BeginCombo(id.c_str(), preview.c_str(),
                                        shown != nullptr ? ImGuiComboFlags_None : ImGuiComboFlags_NoPreview);
    const float height = ImGui::GetFrameHeight();
    if (room.swatch) draw_swatch(panel, at, {at.x + width - height, at.y + height}, *room.swatch);
    if (!open && cut) tooltip_of_button(*shown);
    if (!open) return false;
    begin_rows(room, true);
    open_list().opener_min = {at.x, at.y};
    open_list().opener_max = {at.x + width, at.y + height};
    return true;
}

bool begin_list_of_button(const char* id, bool pressed, ListRoom room) {
    constrain_list(room);
    if (!begin_menu(id, pressed)) return false;
    begin_rows(room, false);
    return true;
}

bool begin_menu(const char* id, bool pressed) {
    if (pressed) {
        note_opener();
        ImGui::OpenPopup(id);
    }
    return ImGui::BeginPopup(id);
}

bool list_row(const std::string& title, bool chosen, const char* why_not,
              const std::optional<glm::vec3>& swatch) {
    SearchText& typed = open_list().typed;
    ++typed.rows;
    if (!contains_text(title, typed.text.data())) return false;
    ++typed.found;
    if (why_not != nullptr) {
        ImGui::Selectable((title + ": " + why_not).c_str(), chosen, ImGuiSelectableFlags_Disabled);
        return false;
    }
    const bool opens_here = chosen && ImGui::IsWindowAppearing();
    if (opens_here) typed.at = typed.hits;
    const bool highlighted = typed.hits++ == typed.at;
    const bool clicked = ImGui::Selectable(title.c_str(), highlighted || (chosen && typed.at < 0));
    if (swatch)
        draw_swatch(*ImGui::GetWindowDrawList(), ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), *swatch);
    if (opens_here || (highlighted && typed.moved)) ImGui::SetScrollHereY();
    const bool taken = clicked || (highlighted && typed.entered);
    if (taken) ImGui::CloseCurrentPopup();
    return taken;
}

void end_list() {
    const OpenList& list = open_list();
    if (list.typed.rows > 0 && list.typed.found == 0) note("No matches.");
    ImGui::EndChild();
    if (list.in_field)
        ImGui::EndCombo();
    else
        ImGui::EndPopup();
}

bool choice_field(const char* name, int& chosen, const char* const* titles, int count,
                  const char* const* why_not, std::span<const glm::vec3> swatches) {
    const auto swatch = [&](int i) {
        return swatches.empty() ? std::nullopt : std::optional(swatches[static_cast<std::size_t>(i)]);
    };
    const auto reason = [&](int i) { return why_not != nullptr ? why_not[i] : nullptr; };
    float width = 0.0f;
    for (int i = 0; i < count; ++i) {
        const char* const why = reason(i);
        const std::string title =
            std::string(titles[i]) + (why != nullptr ? ": " : "") + (why != nullptr ? why : "");
        width = std::max(width, ImGui::CalcTextSize(title.c_str()).x);
    }
    const std::string shown = titles[chosen];
    if (!swatches.empty()) width += ImGui::GetFrameHeight();
    if (!begin_list(name, &shown, {.width = width, .rows = std::min(count, 10), .swatch = swatch(chosen)}))
        return false;
    const int before = chosen;
    for (int i = 0; i < count; ++i)
        if (list_row(titles[i], i == before, reason(i), swatch(i))) chosen = i;
    end_list();
    return chosen != before;
}

void close_lists_on_press() {
    if (!ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup)) return;
    const OpenList& list = open_list();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool on_opener = mouse.x >= list.opener_min.x && mouse.x < list.opener_max.x &&
                           mouse.y >= list.opener_min.y && mouse.y < list.opener_max.y;
    if (!on_opener) ImGui::ClosePopupsOverWindow(ImGui::GetCurrentContext()->HoveredWindow, true);
}

}  // namespace tendril::app
