// Small icons drawn from lines, so that they are sharp at every size and need no font.
#pragma once

#include <imgui.h>

namespace tendril::app {

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
/// The icon alone, in a box of `size` pixels around `centre`.
void draw_icon(ImDrawList* list, Icon icon, ImVec2 centre, float size, ImU32 colour);

}  // namespace tendril::app
