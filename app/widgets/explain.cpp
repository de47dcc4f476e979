// The tooltip of a panel's row: its text, and the range and the unit of its field.
#include <imgui.h>
#include <imgui_internal.h>  // GetItemID() is not public in every version

#include <cmath>
#include <cstdlib>
#include <string>

#include "app/io/text.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/number_entry.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

constexpr double no_limit = 1e6;  ///< limits this large only keep numbers finite, and are not shown

/// "0.25", "1000": no trailing zeros.
std::string plain_number(double value) {
    std::string text = fixed_text(value, 6);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

/// " m", "°": the unit with its leading space, if any.
std::string unit_suffix(std::string unit) {
    unit = unit.substr(0, unit.find(','));  // "°/s, no limit"
    if (unit == "deg") unit = "degrees";
    return unit.empty() || unit.starts_with("\xC2\xB0") ? unit : ' ' + unit;
}

/// " 0 to 10 m."; just the unit if any number is allowed.
std::string range_text(const RowAbove& row) {
    const std::string unit = unit_suffix(unit_of(row.format.data()));
    const bool low = row.low > -no_limit, high = row.high < no_limit;
    if (low && high) return ' ' + plain_number(row.low) + " to " + plain_number(row.high) + unit + '.';
    if (low && row.low > 0.0 && row.low < 1e-5) return " More than 0" + unit + '.';
    if (low) return ' ' + plain_number(row.low) + unit + " or more.";
    if (high) return ' ' + plain_number(row.high) + unit + " or less.";
    if (unit.empty()) return {};
    return unit == " m" ? " In metres." : " In " + unit.substr(unit.find_first_not_of(' ')) + '.';
}

/// True if the last item is the row's field, or follows it in the same row.
bool in_row(const RowAbove& row) {
    const ImVec2 at = ImGui::GetItemRectMin();
    return row.frame == ImGui::GetFrameCount() && at.x > row.field.x - 0.5f &&
           std::abs(at.y - row.field.y) < 0.5f * ImGui::GetTextLineHeight();
}

}  // namespace

void explain(const char* text) {
    const NumberEditing& numbers = number_editing();
    const RowAbove& row = numbers.row;
    const bool of_row = in_row(row);
    ImVec2 low = ImGui::GetItemRectMin();
    // A read-only text has its name to its left; a checkbox includes its name.
    if (of_row)
        low = {row.from.x, row.from.y};
    else if (ImGui::GetItemID() == 0)
        low.x = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMin().x;
    if (!ImGui::IsWindowHovered() || !ImGui::IsMouseHoveringRect(low, ImGui::GetItemRectMax())) return;
    // While dragging or typing, a tooltip would cover the result.
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left) || numbers.id != 0) return;
    std::string whole = text;
    if (whole.empty()) return;
    if (of_row && row.has_range) {
        if (whole.back() != '.') whole += '.';
        whole += range_text(row);
    }
    tooltip(whole);
}

}  // namespace tendril::app
