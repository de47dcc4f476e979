// The fonts that the shell loads, by use, in their order in the atlas.
#pragma once

#include <imgui.h>

namespace tendril::app {

enum class Font { Text, Heading, Small, Verdict };

inline ImFont* font(Font which) {
    return ImGui::GetIO().Fonts->Fonts[static_cast<int>(which)];
}
inline ImFont* small_font() {
    return font(Font::Small);
}
inline ImFont* heading_font() {
    return font(Font::Heading);
}

inline ImFont* verdict_font() {
    return font(Font::Verdict);
}

}  // namespace tendril::app
