#include "app/widgets/fields.hpp"

#include <imgui.h>
#include <imgui_internal.h>  // which item is active

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

#include "app/io/text.hpp"
#include "app/widgets/emit.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/number_entry.hpp"
#include "app/widgets/row_search.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

constexpr float name_share = 0.38f;  ///< fraction of the row's width, if name and field are side by side

/// Too narrow for a name and a field side by side at the current text size.
bool narrow() {
    return ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x <
           9.0f * ImGui::GetFontSize();
}

RowAbove& row_above() {
    return number_editing().row;
}

void note_row(ImVec2 from, ImVec2 field) {
    RowAbove& row = row_above();
    row.frame = ImGui::GetFrameCount();
    row.from = {from.x, from.y};
    row.field = {field.x, field.y};
    row.has_range = false;
}

bool drag_number(const char* id, float& value, float speed, float low, float high, const char* format,
                 const char* at_zero = nullptr) {
    const auto entered = number_entry(id, value, speed, low, high, format, false, at_zero);
    if (!entered) return false;
    constexpr float most = std::numeric_limits<float>::max();  // JSON has no infinity
    const auto wanted = static_cast<float>(*entered);
    value = std::isfinite(wanted) ? wanted : std::copysign(most, wanted);
    return true;
}

void line_below() {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddLine(at, {at.x + ImGui::GetContentRegionAvail().x, at.y},
                                        ImGui::GetColorU32(ImGuiCol_Separator));
    ImGui::Dummy({0.0f, 0.1f * ImGui::GetTextLineHeight()});
}

}  // namespace

std::string begin_row(const char* name) {
    const float from = ImGui::GetWindowContentRegionMin().x;
    const float field = name_share * ImGui::GetWindowContentRegionMax().x;
    const ImVec2 begin = ImGui::GetCursorScreenPos();
    if (name[0] == '#') {  // an id without a visible name
        ImGui::SetNextItemWidth(-1.0f);
        note_row(begin, begin);
        return name;
    }
    const float until = ImGui::GetCursorPosX() - from + ImGui::CalcTextSize(name).x;
    const bool below = narrow() || until > field;
    if (below) {
        text_elided(name, ImGui::GetContentRegionAvail().x, true);
    } else {
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("%s", name);
        ImGui::SameLine(from + field);
    }
    ImGui::SetNextItemWidth(-1.0f);
    note_row(begin, ImGui::GetCursorScreenPos());
    return std::string("##") + name;
}

void tooltip_of_button(const std::string& text) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) tooltip(text);
}

IdScope::IdScope(const char* name) {
    ImGui::PushID(name);
}
IdScope::~IdScope() {
    ImGui::PopID();
}

PanelSection::PanelSection(const char* title) : ids(title) {
    ImGui::Dummy({0.0f, 0.35f * ImGui::GetTextLineHeight()});
    note_section(title);
    ImGui::TextUnformatted(title);
    line_below();
}

bool section_button(const char* title, bool open) {
    ImGui::Dummy({0.0f, 0.35f * ImGui::GetTextLineHeight()});
    note_section(title);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeight(), width = std::max(1.0f, ImGui::GetContentRegionAvail().x);
    const bool clicked = ImGui::InvisibleButton((std::string("section ") + title).c_str(), {width, line});
    const ImU32 colour = ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    if (ImGui::IsItemHovered()) tooltip(open ? "Click folds this section" : "Click unfolds it");
    const ImVec2 below = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos(at);
    ImGui::TextUnformatted(title);
    ImGui::SetCursorScreenPos(below);
    draw_icon(ImGui::GetWindowDrawList(), open ? Icon::ChevronDown : Icon::ChevronRight,
              {at.x + width - 0.45f * line, at.y + 0.5f * line}, 1.2f * line, colour);
    line_below();
    return clicked;
}

float verdict_height(int lines) {
    const float above = 0.2f * ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().ItemSpacing.y;
    ImGui::PushFont(verdict_font());
    const float line = ImGui::GetTextLineHeight();
    ImGui::PopFont();
    return above + static_cast<float>(lines) * line;
}

void verdict(const std::string& text, glm::vec3 colour) {
    ImGui::Dummy({0.0f, 0.2f * ImGui::GetTextLineHeight()});
    ImGui::PushFont(verdict_font());
    coloured_note(text, colour);
    ImGui::PopFont();
}

void note(const std::string& text) {
    const ImVec4 dim = ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
    coloured_note(text, {dim.x, dim.y, dim.z});
}

void coloured_note(const std::string& text, glm::vec3 colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, {colour.r, colour.g, colour.b, 1.0f});
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str(), text.c_str() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

bool number_field(const char* name, float& value, float speed, float low, float high, const char* format,
                  const char* at_zero) {
    const std::string id = begin_row(name);
    return drag_number(id.c_str(), value, speed, low, high, format, at_zero);
}

bool integer_field(const char* name, int& value, int low, int high) {
    const std::string id = begin_row(name);
    const auto entered = number_entry(id.c_str(), value, 0.1, low, high, "%.0f", true);
    if (!entered) return false;
    using Limits = std::numeric_limits<int>;
    value = static_cast<int>(std::clamp<double>(std::round(*entered), Limits::min(), Limits::max()));
    return true;
}

bool integer_slider(const char* name, int& value, int low, int high) {
    const std::string id = begin_row(name);
    // The number is beside the slider, where the knob does not hide it.
    const float room =
        ImGui::CalcTextSize(std::to_string(high).c_str()).x + ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::SetNextItemWidth(-room);
    const bool changed = ImGui::SliderInt(id.c_str(), &value, low, high, "", ImGuiSliderFlags_NoInput);
    row_above().has_range = true;
    row_above().low = low;
    row_above().high = high;
    row_above().format = {"%d"};
    ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::Text("%d", value);
    return changed;
}

bool shows_cut_text(const char* id, const std::string& text) {
    TextEditing& typed = number_editing().typed;
    const ImGuiID own = ImGui::GetID(id);
    constexpr int frames_to_focus = 4;
    const int left = typed.wanted_until - ImGui::GetFrameCount();
    if (typed.wanted == own && left >= 0) {
        if (left + 1 == frames_to_focus) ImGui::SetKeyboardFocusHere();
        return false;
    }
    const float width = ImGui::CalcItemWidth();
    const std::string cut = elided_in_middle(text, width - 2.0f * ImGui::GetStyle().FramePadding.x);
    if (ImGui::GetActiveID() == own || cut == text) return false;
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0.0f, 0.5f});
    for (const auto colour : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive})
        ImGui::PushStyleColor(colour, ImGui::GetStyleColorVec4(ImGuiCol_FrameBg));
    if (ImGui::Button((cut + "###" + id + " cut").c_str(), {width, 0.0f})) {
        typed.wanted = own;
        typed.wanted_until = ImGui::GetFrameCount() + frames_to_focus;
    }
    ImGui::PopStyleColor(3);
    ImGui::PopStyleVar();
    tooltip_of_button(text);
    return true;
}

bool text_field(const char* name, std::string& value, const char* hint, float room) {
    const std::string id = begin_row(name);
    if (room > 0.0f) ImGui::SetNextItemWidth(-room);
    TextEditing& typed = number_editing().typed;
    const ImGuiID own = ImGui::GetID(id.c_str());
    const int frame = ImGui::GetFrameCount();
    const bool edited = typed.id == own && typed.frame >= frame - 1;
    auto text = decltype(typed.text)();
    value.copy(text.data(), text.size() - 1);
    const auto given = text;
    if (edited) text = typed.text;
    if (!edited && shows_cut_text(id.c_str(), value)) return false;
    const float width = ImGui::CalcItemWidth() - ImGui::GetStyle().FramePadding.x;
    const bool entered =
        ImGui::InputTextWithHint(id.c_str(), elided_in_middle(hint, width).c_str(), text.data(), text.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    if (ImGui::IsItemActive()) {
        if (!edited) typed.before = given;
        typed.id = own, typed.frame = frame, typed.text = text;
    } else if (edited) {
        typed.id = 0;
    }
    const bool left = edited && !ImGui::IsItemActive() && !escape_pressed() && text != typed.before;
    value = text.data();
    return (entered || left) && !value.empty();
}

bool path_field(const char* name, std::string& value, const char* hint, const char* by, Emit& emit) {
    const bool entered = text_field(name, value, hint, field_button_width("Browse"));
    if (field_button("Browse", name)) emit("scene.open_dialog", {{"by", by}});
    return entered;
}

float field_button_width(const char* title) {
    const ImGuiStyle& style = ImGui::GetStyle();
    return ImGui::CalcTextSize(title).x + style.FramePadding.x + style.ItemInnerSpacing.x;
}

bool field_button(const char* title, const char* name) {
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.5f * padding.x, padding.y});
    const bool pressed = ImGui::Button((std::string(title) + "##" + name).c_str());
    ImGui::PopStyleVar();
    return pressed;
}

bool point_field(const char* name, glm::vec3& value, float speed, float most, const char* format) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    bool changed = false;
    for (int i = 0; i < 3; ++i) {
        const std::string row = std::string(name) + " " + "xyz"[i];
        const std::string id = begin_row(row.c_str());
        changed |= drag_number(id.c_str(), value[i], speed, -most, most, format);
    }
    row_above().from = {from.x, from.y};  // explain() treats all three as one row
    return changed;
}

bool vector_field(const char* name, glm::vec3& value, float speed, glm::vec3 low, glm::vec3 high,
                  const char* format) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 2.0f * gap) / 3.0f;
    ImVec2 from = ImGui::GetCursorScreenPos();
    text_elided(name, ImGui::GetContentRegionAvail().x, true);
    const ImVec2 fields = ImGui::GetCursorScreenPos();
    if (fields.x < from.x) from = fields;  // a part left of the name has a tooltip of its own
    bool changed = false;
    for (int i = 0; i < 3; ++i) {
        const std::string id = std::string("##") + name + ' ' + "xyz"[i];
        if (i > 0) ImGui::SameLine(0.0f, gap);
        ImGui::SetNextItemWidth(width);
        note_row(from, ImGui::GetCursorScreenPos());
        changed |= drag_number(id.c_str(), value[i], speed, low[i], high[i], format);
    }
    if (low != glm::vec3(low.x) || high != glm::vec3(high.x)) row_above().has_range = false;
    return changed;
}

void keep_room(const char* id, float top, float min_height) {
    float& room = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID(id), 0.0f);
    const bool keeps = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    room = std::max({ImGui::GetCursorPosY() - top, min_height, keeps ? room : 0.0f});
    ImGui::SetCursorPosY(top + room);
}

float note_height(int lines) {
    return static_cast<float>(lines) * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
}

void kept_note(const char* id, const std::string& text, int lines) {
    const float top = ImGui::GetCursorPosY();
    if (!text.empty()) note(text);
    keep_room(id, top, note_height(lines));
}

bool option_button(const char* title, bool chosen, const char* tooltip) {
    const float room =
        ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemInnerSpacing.x;
    const std::string shown = elided(title, room);
    const bool pressed = ImGui::RadioButton((shown + "###" + title).c_str(), chosen);
    const std::string whole = shown != title ? title : "";
    const std::string more = tooltip != nullptr ? tooltip : "";
    const std::string text = whole + (whole.empty() || more.empty() ? "" : ": ") + more;
    if (!text.empty()) tooltip_of_button(text);
    return pressed;
}

void reading(const char* name, const char* format, ...) {
    char text[128];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const std::string shown = without_signed_zero(text);
    const float needed =
        ImGui::CalcTextSize(name).x + ImGui::CalcTextSize(shown.c_str()).x + ImGui::GetFontSize();
    if (needed > ImGui::GetContentRegionAvail().x) {
        text_elided(name, ImGui::GetContentRegionAvail().x, true);
    } else {
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("%s", name);
        ImGui::SameLine();
    }
    text_flush_right(shown);
}

bool row_button(const char* title, int of, bool enabled, const char* tooltip) {
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float whole = ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x;
    // Fewer per row if they would be narrower than this; four or more are symbols rather than words.
    const float min_width = (of > 3 ? 2.2f : 4.5f) * ImGui::GetFontSize();
    of = std::clamp(static_cast<int>((whole + gap) / (min_width + gap)), 1, of);
    const auto share = [&] { return (whole - gap * static_cast<float>(of - 1)) / static_cast<float>(of); };
    const std::string visible(title, ImGui::FindRenderedTextEnd(title));
    const float needed = ImGui::CalcTextSize(visible.c_str()).x + ImGui::GetStyle().FramePadding.x;
    while (of > 1 && share() < needed) --of;  // the title must fit
    const float width = share();
    const bool begun = ImGui::GetCursorPosX() > ImGui::GetWindowContentRegionMin().x + 1.0f;
    if (begun && ImGui::GetCursorPosX() + width > ImGui::GetWindowContentRegionMax().x + 1.0f)
        ImGui::NewLine();
    const std::string shown = elided(visible, width - ImGui::GetStyle().FramePadding.x);
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.5f * padding.x, padding.y));
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button((shown + "###" + title).c_str(), {width, 0.0f});
    ImGui::EndDisabled();
    ImGui::PopStyleVar();
    if (tooltip != nullptr) tooltip_of_button(tooltip);
    ImGui::SameLine();  // the next button continues the row, unless it is full
    if (ImGui::GetCursorPosX() + width > ImGui::GetWindowContentRegionMax().x + 1.0f) ImGui::NewLine();
    return pressed;
}

bool row_option(const char* title, int of, bool chosen, const char* tooltip) {
    ImGui::PushStyleColor(ImGuiCol_Button,
                          ImGui::GetStyleColorVec4(chosen ? ImGuiCol_Header : ImGuiCol_Button));
    const bool pressed = row_button(title, of, true, tooltip);
    ImGui::PopStyleColor();
    return pressed;
}

void end_row() {
    if (ImGui::GetCursorPosX() > ImGui::GetWindowContentRegionMin().x + 1.0f) ImGui::NewLine();
}

}  // namespace tendril::app
