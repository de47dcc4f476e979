// The look of the panels: Dear ImGui's style from the palette, and the fonts.
#pragma once

#include <imgui.h>

#include <glm/vec3.hpp>

#include "app/view/palette.hpp"

namespace tendril::app {

inline ImVec4 imgui_colour(glm::vec3 c, float alpha = 1.0f) {
    return {c.r, c.g, c.b, alpha};
}
inline ImU32 imgui_u32(glm::vec3 c, float alpha = 1.0f) {
    return ImGui::ColorConvertFloat4ToU32(imgui_colour(c, alpha));
}

void apply_theme(Theme theme, float scale);

}  // namespace tendril::app
