#include "app/shell/command_palette.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/widgets/fields.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

/// Positions of the columns, in pixels from the left.
struct Columns {
    float where = 0.0f, syntax = 0.0f, keys = 0.0f;
    bool two_lines = false;  ///< the syntax is below the title
    float height = 0.0f;     ///< a row's
};

/// Pixels between columns; margin() is before the first.
float gap() {
    return 1.2f * ImGui::GetFontSize();
}
float margin() {
    return 0.4f * ImGui::GetFontSize();
}

float width_of(const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x;
}

Columns columns(const std::vector<PaletteRow>& rows, float width) {
    float title = 0.0f, where = 0.0f, name = 0.0f, keys = 0.0f;
    for (const PaletteRow& row : rows) {
        title = std::max(title, width_of(row.title));
        where = std::max(where, width_of(row.where));
        name = std::max(name, width_of(row.syntax.substr(0, row.syntax.find(' ')) + " ..."));
        keys = std::max(keys, width_of(row.keys));
    }
    Columns c;
    c.where = margin() + title + gap();
    c.syntax = c.where + (where > 0.0f ? where + gap() : 0.0f);
    c.keys = width - keys - margin();
    c.two_lines = c.syntax + name + gap() > c.keys;
    c.height = ImGui::GetTextLineHeightWithSpacing() + (c.two_lines ? ImGui::GetTextLineHeight() : 0.0f);
    return c;
}

void write_at(ImVec2 at, const std::string& text, bool bright) {
    const ImU32 colour = ImGui::GetColorU32(bright ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    ImGui::GetWindowDrawList()->AddText(at, colour, text.c_str(), text.c_str() + text.size());
}

void write_row(const PaletteRow& row, const Columns& c, ImVec2 from) {
    const auto at = [&](float x, float y = 0.0f) { return ImVec2(std::floor(from.x + x), from.y + y); };
    const float right = c.keys - (row.keys.empty() ? 0.0f : gap());
    if (c.two_lines) {
        write_at(at(margin()), elided_at_word(row.title, right - margin()), !row.done);
        const std::string below = row.where.empty() ? row.syntax : row.where + ":  " + row.syntax;
        write_at(at(gap(), ImGui::GetTextLineHeight()), elided_at_word(below, right - gap()), false);
    } else {
        write_at(at(margin()), row.title, !row.done);
        write_at(at(c.where), row.where, false);
        write_at(at(c.syntax), elided_at_word(row.syntax, c.keys - gap() - c.syntax), false);
    }
    write_at(at(c.keys), row.keys, false);
}

/// Scrolls by the minimum that shows all of the last item.
void scroll_to_item() {
    const float top = ImGui::GetWindowPos().y, bottom = top + ImGui::GetWindowSize().y;
    if (ImGui::GetItemRectMin().y < top) ImGui::SetScrollHereY(0.0f);
    if (ImGui::GetItemRectMax().y > bottom) ImGui::SetScrollHereY(1.0f);
}

}  // namespace

float palette_list_height(const std::vector<PaletteRow>& rows, float width) {
    return static_cast<float>(std::max<std::size_t>(rows.size(), 3)) * columns(rows, width).height;
}

std::optional<std::size_t> palette_list(const std::vector<PaletteRow>& rows, int chosen,
                                        bool bring_choice_into_view, float below) {
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float width = std::max(1.0f, room.x - ImGui::GetStyle().ScrollbarSize);
    const Columns c = columns(rows, width);
    const float whole = std::max(1.0f, std::floor((room.y - below) / c.height)) * c.height;
    std::optional<std::size_t> clicked;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0.0f, 0.0f));
    ImGui::BeginChild("found", {0.0f, whole}, false, ImGuiWindowFlags_NoNav);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool is_chosen = static_cast<int>(i) == chosen;
        const ImVec2 from = ImGui::GetCursorScreenPos();
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable("##row", is_chosen, ImGuiSelectableFlags_None, {width, c.height})) clicked = i;
        ImGui::PopID();
        if (is_chosen && bring_choice_into_view) scroll_to_item();
        if (!ImGui::IsItemVisible()) continue;
        explain(rows[i].help.c_str());
        write_row(
            rows[i], c,
            {from.x, from.y + 0.5f * (c.height - ImGui::GetTextLineHeight() * (c.two_lines ? 2.0f : 1.0f))});
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    return clicked;
}

}  // namespace tendril::app
