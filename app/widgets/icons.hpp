// Small icons drawn from lines, so that they are sharp at every size and need no font; colours for them.
#pragma once

#include <imgui.h>

#include <glm/vec3.hpp>

namespace tendril::app {

inline ImVec4 imgui_colour(glm::vec3 c, float alpha = 1.0f) {
    return {c.r, c.g, c.b, alpha};
}
inline ImU32 imgui_u32(glm::vec3 c, float alpha = 1.0f) {
    return ImGui::ColorConvertFloat4ToU32(imgui_colour(c, alpha));
}

enum class Icon {
    Menu,
    Undo,
    Redo,
    Play,
    Pause,
    Step,
    Help,
    Gear,
    ChevronLeft,
    ChevronRight,
    ChevronDown,
    Close,
    Check,
    Record
};

/// A square, frameless button of the frame's height. `tooltip` may be null.
bool icon_button(const char* id, Icon icon, const char* tooltip, bool enabled = true, bool active = false);
/// Only the icon, in a box of `size` pixels around `centre`.
void draw_icon(ImDrawList* list, Icon icon, ImVec2 centre, float size, ImU32 colour);

}  // namespace tendril::app
