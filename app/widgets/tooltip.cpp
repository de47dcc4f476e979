#include "app/widgets/tooltip.hpp"

#include <imgui.h>
#include <imgui_internal.h>  // the window that an item's child window belongs to
#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <utility>

#include "app/widgets/number_entry.hpp"

namespace tendril::app {
namespace {

// In font sizes.
constexpr float widest = 22.0f, narrowest = 10.0f, lowest = 4.0f, tall_item = 8.0f, tooltip_margin = 2.0f;

glm::vec2 vec(ImVec2 v) {
    return {v.x, v.y};
}

Rect last_item() {
    return {vec(ImGui::GetItemRectMin()), vec(ImGui::GetItemRectMax())};
}

/// The rectangle that a tooltip may use, and the part of it to keep free.
struct TooltipRoom {
    Rect whole, free;
    int axis = 0;  ///< 0: preferably right or left of `free`; 1: preferably below or above
};

/// The room for an item that is not in a panel, a bar or a sheet.
TooltipRoom room_in_middle(const Rect& item) {
    const NumberEditing& numbers = number_editing();
    return {{numbers.middle_min, numbers.middle_max}, item, 1};
}

/// True if the last item is in a sheet or a list, over panels and bars.
bool floats() {
    return (ImGui::GetCurrentWindowRead()->RootWindow->Flags & ImGuiWindowFlags_NoBringToFrontOnFocus) == 0;
}

TooltipRoom room_of_last_item() {
    const ImGuiWindow& root = *ImGui::GetCurrentWindowRead()->RootWindow;
    const Rect window{vec(root.Pos), vec(root.Pos) + vec(root.Size)};
    if (floats()) return {{{0.0f, 0.0f}, vec(ImGui::GetIO().DisplaySize)}, window};
    const TooltipRoom middle = room_in_middle(last_item());
    return middle.whole.contains(window.centre()) ? middle : TooltipRoom{middle.whole, window};
}

/// Sets the next window's position, and returns its width in pixels.
float place_tooltip(const TooltipRoom& room, const Rect& item) {
    const float em = ImGui::GetFontSize(), gap = 0.5f * em;
    const glm::vec2 low = room.whole.min + gap, high = room.whole.max - gap;
    glm::vec2 at = glm::clamp(vec(ImGui::GetMousePos()), item.min, item.max), pivot{0.0f};
    float width = widest * em;
    if (room.axis == 1 && item.size().y > tall_item * em) {
        // For a plot, which fills the middle: the upper corner away from the mouse.
        pivot.x = at.x < item.centre().x ? 1.0f : 0.0f;
        at = {pivot.x > 0.5f ? item.max.x - gap : item.min.x + gap, item.min.y + gap};
        ImGui::SetNextWindowPos({at.x, at.y}, ImGuiCond_Always, {pivot.x, pivot.y});
        return width;
    }
    at = glm::clamp(at, low, glm::max(low, high));
    pivot = (at - low) / glm::max(high - low, 1.0f);  // extends to both sides of the mouse, so that it fits
    const glm::vec2 needed = em * glm::vec2(narrowest + tooltip_margin, lowest);
    for (const int axis : {room.axis, 1 - room.axis}) {
        const float before = room.free.min[axis] - gap - low[axis],
                    after = high[axis] - room.free.max[axis] - gap;
        const float most = std::min(std::max(before, after), high[axis] - low[axis]);
        if (most < needed[axis]) continue;
        at[axis] = after >= before ? std::max(room.free.max[axis] + gap, low[axis])
                                   : std::min(room.free.min[axis] - gap, high[axis]);
        pivot[axis] = after >= before ? 0.0f : 1.0f;
        ImGui::SetNextWindowPos({at.x, at.y}, ImGuiCond_Always, {pivot.x, pivot.y});
        return std::min(width, (axis == 0 ? most : high.x - low.x) - tooltip_margin * em);
    }
    return width;  // no room: at the mouse
}

void begin_tooltip(float width) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(width);
}

float width_of(const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x;
}

void write(const std::string& text, bool dim) {
    if (dim) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(text.c_str(), text.c_str() + text.size());
    if (dim) ImGui::PopStyleColor();
}

/// The start of the UTF-8 character that contains byte `at`.
std::size_t character_begin(const std::string& text, std::size_t at) {
    while (at > 0 && at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) --at;
    return at;
}

}  // namespace

Tooltip::Tooltip() {
    begin_tooltip(place_tooltip(room_of_last_item(), last_item()));
}

Tooltip::Tooltip(const Rect& drawn) {
    begin_tooltip(place_tooltip(room_in_middle(drawn), drawn));
}

Tooltip::~Tooltip() {
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

namespace {

/// True if the item was clicked; its tooltip then stays hidden until the mouse has left, to show the result.
bool was_clicked() {
    const double hovered_since =
        ImGui::GetTime() - static_cast<double>(ImGui::GetCurrentContext()->HoveredIdTimer);
    return ImGui::GetCurrentContext()->HoveredId != 0 && ImGui::GetIO().MouseClickedTime[0] > hovered_since;
}

}  // namespace

void tooltip(const std::string& text) {
    if (was_clicked() || (number_editing().covered && !floats())) return;
    const Tooltip opened;
    ImGui::TextUnformatted(text.c_str());
}

void tell_below(const std::string& text) {
    const float below = ImGui::GetItemRectMax().y + ImGui::GetStyle().ItemInnerSpacing.y;
    ImGui::SetNextWindowPos({ImGui::GetItemRectMin().x, below});
    begin_tooltip(18.0f * ImGui::GetFontSize());
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

std::string elided(const std::string& text, float width) {
    if (width_of(text) <= width) return text;
    std::size_t fits = 0, too_many = text.size();
    while (fits + 1 < too_many) {
        const std::size_t middle = (fits + too_many) / 2;
        const bool ok = width_of(text.substr(0, character_begin(text, middle)) + "...") <= width;
        (ok ? fits : too_many) = middle;
    }
    std::string cut = text.substr(0, character_begin(text, fits));
    while (!cut.empty() && (cut.back() == ' ' || cut.back() == '.')) cut.pop_back();
    return cut + "...";
}

std::string elided_in_middle(const std::string& text, float width) {
    if (width_of(text) <= width) return text;
    const auto cut_to = [&](std::size_t kept) {
        const std::size_t begin = kept / 4, before = character_begin(text, begin),
                          after = character_begin(text, text.size() - (kept - begin));
        return text.substr(0, before) + "..." + text.substr(after);
    };
    std::size_t fits = 0, too_many = text.size();
    while (fits + 1 < too_many) {
        const std::size_t middle = (fits + too_many) / 2;
        (width_of(cut_to(middle)) <= width ? fits : too_many) = middle;
    }
    return cut_to(fits);
}

std::string elided_at_word(const std::string& text, float width) {
    if (width_of(text) <= width) return text;
    std::string best;
    for (std::size_t end = text.find(' '); end != text.npos; end = text.find(' ', end + 1)) {
        std::string cut = text.substr(0, end) + " ...";
        if (width_of(cut) > width) break;
        best = std::move(cut);
    }
    return best;
}

void text_elided(const std::string& text, float width, bool dim) {
    const std::string shown = elided(text, width);
    write(shown, dim);
    if (shown != text && ImGui::IsItemHovered()) tooltip(text);
}

void text_flush_right(const std::string& text, bool dim) {
    const float room = ImGui::GetContentRegionAvail().x - width_of(text);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, room));
    write(text, dim);
}

bool escape_pressed() {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
}

void close_popup_on_escape() {
    if (escape_pressed()) ImGui::CloseCurrentPopup();
}

}  // namespace tendril::app
