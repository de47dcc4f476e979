#include "app/widgets/fields.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdarg>

namespace tendril::app {
namespace {

/// Writes the row's name and leaves the cursor where its field goes; gives the field's id.
std::string begin_row(const char* name) {
    const float share = 0.38f;
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", name);
    ImGui::SameLine(ImGui::GetWindowContentRegionMin().x + share * ImGui::GetWindowContentRegionMax().x);
    ImGui::SetNextItemWidth(-1.0f);
    return std::string("##") + name;
}

}  // namespace

void section(const char* title) {
    ImGui::Dummy({0.0f, 0.35f * ImGui::GetTextLineHeight()});
    ImGui::TextUnformatted(title);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddLine(at, {at.x + ImGui::GetContentRegionAvail().x, at.y},
                                        ImGui::GetColorU32(ImGuiCol_Separator));
    ImGui::Dummy({0.0f, 0.1f * ImGui::GetTextLineHeight()});
}

void note(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str(), text.c_str() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

bool number_field(const char* name, float& value, float speed, float low, float high, const char* format) {
    const std::string id = begin_row(name);
    return ImGui::DragFloat(id.c_str(), &value, speed, low, high, format, ImGuiSliderFlags_AlwaysClamp);
}

bool integer_field(const char* name, int& value, int low, int high) {
    const std::string id = begin_row(name);
    return ImGui::DragInt(id.c_str(), &value, 0.1f, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
}

bool integer_slider(const char* name, int& value, int low, int high) {
    const std::string id = begin_row(name);
    return ImGui::SliderInt(id.c_str(), &value, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
}

bool point_field(const char* name, glm::vec3& value, float speed) {
    constexpr float most = 1e9f;
    bool changed = false;
    for (int i = 0; i < 3; ++i) {
        const std::string row = std::string(name) + " " + "xyz"[i];
        changed |= number_field(row.c_str(), value[i], speed, -most, most, "%.3f m");
    }
    return changed;
}

bool choice_field(const char* name, int& chosen, const char* const* titles, int count) {
    const std::string id = begin_row(name);
    return ImGui::Combo(id.c_str(), &chosen, titles, count);
}

void reading(const char* name, const char* format, ...) {
    begin_row(name);
    char text[128];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    // Set flush right, so that digits stay under digits.
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, room));
    ImGui::TextUnformatted(text);
}

bool row_button(const char* title, int of, bool enabled, const char* tooltip) {
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float whole = ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x;
    const float width = (whole - gap * static_cast<float>(of - 1)) / static_cast<float>(of);
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(title, {width, 0.0f});
    ImGui::EndDisabled();
    if (tooltip != nullptr && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", tooltip);
    ImGui::SameLine();  // the next one beside it, unless the row is full
    if (ImGui::GetCursorPosX() + width > ImGui::GetWindowContentRegionMax().x + 1.0f) ImGui::NewLine();
    return pressed;
}

}  // namespace tendril::app
