#include "app/widgets/number_entry.hpp"

#include <imgui.h>
#include <imgui_internal.h>  // the only way to ask whether the next item is disabled

#include <cmath>
#include <cstdio>
#include <utility>

#include "app/document/units.hpp"
#include "app/widgets/expression.hpp"
#include "app/widgets/text.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

NumberEditing& number_editing() {
    return *static_cast<NumberEditing*>(ImGui::GetIO().UserData);
}

namespace {

bool is_disabled() {
    return (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0;
}

void note_range(double low, double high, const char* format) {
    RowAbove& row = number_editing().row;
    row.has_range = true;
    row.low = low;
    row.high = high;
    std::snprintf(row.format.data(), row.format.size(), "%s", format);
}

bool is_edited(ImGuiID id) {
    // A field that was not drawn in the last frame has vanished, with its text.
    return number_editing().id == id && number_editing().frame >= ImGui::GetFrameCount() - 1;
}

void begin_editing(ImGuiID id, double value) {
    NumberEditing& now = number_editing();
    now.id = id;
    now.frame = ImGui::GetFrameCount();
    now.begins = true;
    now.tabbed_in = -1;
    std::snprintf(now.text.data(), now.text.size(), "%.7g", value == 0.0 ? 0.0 : value);
    now.before = now.text;
}

ImVec4 mixed_with_red(const ImVec4& colour) {
    const auto mixed = [](float from, float to) { return from + 0.4f * (to - from); };
    return {mixed(colour.x, 0.9f), mixed(colour.y, 0.15f), mixed(colour.z, 0.1f), 1.0f};
}

TypedNumber read(const char* text, const std::string& unit, bool whole) {
    TypedNumber typed = read_number(text, unit);
    if (whole && typed.value && std::isfinite(*typed.value) && *typed.value != std::round(*typed.value))
        typed = {std::nullopt, '"' + std::string(text) + "\" is not a whole number"};
    return typed;
}

std::optional<double> edited_text(const char* id, const std::string& unit, bool whole) {
    NumberEditing& now = number_editing();
    now.frame = ImGui::GetFrameCount();
    if (std::exchange(now.begins, false)) ImGui::SetKeyboardFocusHere();
    const auto is_empty = [&] { return now.text[0] == '\0'; };
    const bool was_wrong = !is_empty() && !read(now.text.data(), unit, whole).value;
    if (was_wrong)
        ImGui::PushStyleColor(ImGuiCol_FrameBg, mixed_with_red(ImGui::GetStyleColorVec4(ImGuiCol_FrameBg)));
    const std::string text_id = std::string(id) + " text";
    // ImGui's own Tab goes to the next text field, and a number is not one until it is clicked.
    bool tabbed = false;
    const auto take_tab = [](ImGuiInputTextCallbackData* data) {
        *static_cast<bool*>(data->UserData) = true;
        return 0;
    };
    const bool entered =
        ImGui::InputText(text_id.c_str(), now.text.data(), now.text.size(),
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
                             ImGuiInputTextFlags_CallbackCompletion,
                         take_tab, &tabbed);
    const bool left = tabbed || ImGui::IsItemDeactivated();
    if (was_wrong) ImGui::PopStyleColor();
    const TypedNumber typed = read(now.text.data(), unit, whole);
    const bool wrong = !is_empty() && !typed.value;
    if (!entered && !left) {
        if (wrong && ImGui::IsItemActive()) tell_below(typed.error);
        return std::nullopt;
    }
    const bool same = now.text == now.before;
    if (wrong && entered) {  // Enter keeps the invalid text in edit
        now.begins = true;
        return std::nullopt;
    }
    now.id = 0;
    if (tabbed) now.tabbed_in = ImGui::GetFrameCount();
    if (escape_pressed() || is_empty() || same) return std::nullopt;
    if (wrong) now.refused = typed.error;
    now.entered = now.entered || typed.value;
    return typed.value;
}

}  // namespace

std::optional<double> number_entry(const char* id, double value, double speed, double low, double high,
                                   const char* format, bool whole, const char* at_zero) {
    const ImGuiID own = ImGui::GetID(id);
    note_range(low, high, format);
    if (number_editing().tabbed_in == ImGui::GetFrameCount() && !is_disabled()) begin_editing(own, value);
    if (is_edited(own)) return edited_text(id, unit_of(format), whole);

    char text[64];
    std::snprintf(text, sizeof text, format, value);
    double shown = without_signed_zero(text) == text ? value : 0.0;
    const char* const seen = at_zero != nullptr && value == 0.0 ? at_zero : format;
    const ImGuiIO& io = ImGui::GetIO();
    // ImGui makes a drag ten times coarser with Shift; this makes it ten times finer.
    const auto pace = static_cast<float>(io.KeyShift ? 0.01 * speed : speed);
    const bool changed = ImGui::DragScalar(id, ImGuiDataType_Double, &shown, pace, &low, &high, seen,
                                           ImGuiSliderFlags_NoInput);
    const bool clicked = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
                         io.MouseDragMaxDistanceSqr[0] < io.MouseDragThreshold * io.MouseDragThreshold;
    if (clicked && !changed) begin_editing(own, value);
    return changed ? std::optional(shown) : std::nullopt;
}

}  // namespace tendril::app
