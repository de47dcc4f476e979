// The window around the labs: bars, panels, and what lies over the scene for a while. It reads the workspace
// and emits commands.
#pragma once

#include <imgui.h>

#include <span>
#include <string>

#include "app/labs/card.hpp"
#include "app/labs/labs.hpp"
#include "app/shell/command_palette.hpp"
#include "app/shell/file_dialog.hpp"
#include "app/shell/layout.hpp"
#include "app/shell/shortcuts.hpp"

namespace tendril::app {

/// What a frame of the shell shows beside the workspace.
struct ShellFrame {
    const Workspace& workspace;
    const Labs& labs;
    const Lab& lab;
    const CommandTable& commands;
    const Shortcuts& shortcuts;
    const Layout& layout;
    std::string hint;               ///< what the mouse would do where it is
    const Card* card = nullptr;     ///< of things to try, where one is shown
    std::span<const Card> cards{};  ///< all of the lab's

    glm::vec2 screen() const { return {layout.top.max.x, layout.status.max.y}; }
    const Palette& colours() const { return palette(workspace.settings.theme); }
    bool works_here(const Shortcut& shortcut) const {
        return shortcut.lab.empty() || shortcut.lab == workspace.lab;
    }
};

class Shell {
  public:
    void frame(const ShellFrame& frame, Emit& emit);
    /// What the last frame wrote on the scene: hint, legend and axis gizmo.
    const std::vector<Rect>& overlays() const { return overlays_; }

  private:
    void side_panel(const ShellFrame& frame, bool left, Emit& emit);

    float overflow_[2] = {0.0f, 0.0f};  ///< how far each side panel can scroll
    std::vector<Rect> overlays_;
    PickId lit_ = no_pick;  ///< of the handle that lights up; see show_card_halo()
    CommandPalette palette_;
    FileDialog file_dialog_;
};

// What lies over the scene; each in a file of its own.
void show_help(const ShellFrame& frame, Emit& emit);
void show_settings(const ShellFrame& frame, Emit& emit);
void show_recovery(const ShellFrame& frame, Emit& emit);
void show_quit(const ShellFrame& frame, Emit& emit);
void show_filming(const ShellFrame& frame, Emit& emit);
void show_toasts(const ShellFrame& frame);
// Those below say where they are; without size where they are not shown.
Rect show_first_hint(const ShellFrame& frame);
Rect show_legend(const ShellFrame& frame);

/// A fixed window without decoration that fills `rect`; one that `scrolls` has a bar where there is more in
/// it than room. Always ImGui::End() after it.
void begin_region(const char* name, const Rect& rect, glm::vec3 colour, ImVec2 padding, bool scrolls = false);

/// A window of the given share of the screen in the middle of it, closed by Escape or the cross; false once
/// closed.
bool begin_sheet(const char* title, glm::vec2 screen, glm::vec2 wanted);

}  // namespace tendril::app
