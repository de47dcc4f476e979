#include "app/widgets/text.hpp"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

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
