// The window around the labs: bars, panels and overlays, their layout, and the sections that unfold for a
// card or command. It reads the workspace and emits commands.
#pragma once

#include <imgui.h>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "app/document/settings.hpp"
#include "app/labs/card.hpp"
#include "app/labs/labs.hpp"
#include "app/shell/command_palette.hpp"
#include "app/shell/file_dialog.hpp"
#include "app/shell/shortcuts.hpp"
#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

struct ShellFrame;

/// Unfolds the sections that hide the rows of a card's step or a palette's command.
class Unfolding {
  public:
    /// Unfolds once for each step, so that the user can fold it again.
    void for_step(const ShellFrame& frame, const CardStep* step, Emit& emit);
    void for_command(const ShellFrame& frame, const Emitted& command, Emit& emit);

  private:
    const CardStep* step_ = nullptr;
};

/// Divides the window into bars, panels and the 3D view.
struct Layout {
    Rect top, left, right, timeline, status, canvas, view;
    float scale = 1.0f;
    bool left_open = true, right_open = true;
    bool one_panel = false;  ///< only one side panel fits
    bool upright = false;    ///< the right one is below the scene: the window is a phone's
};

/// Everything is in window coordinates. `timeline`: height of the time strip at scale 1. In a narrow window
/// the panels shrink before the middle does; a folded panel leaves a slim strip to unfold it. In an upright
/// one the right panel is below the scene and, folded, leaves the verdict. `canvas`: the fraction of the
/// middle, from the left, that the lab's own plots take from the 3D view, 0 to 1.
Layout lay_out(glm::vec2 window, float scale, const Settings& settings, float timeline, float canvas = 0.0f);

/// The contents of a frame of the shell.
struct ShellFrame {
    const Workspace& workspace;
    const Labs& labs;
    const Lab& lab;
    const CommandTable& commands;
    const Shortcuts& shortcuts;
    const Layout& layout;
    std::string hint;                 ///< the mouse's effect where it is; empty: in the view
    bool by_finger = false;           ///< the last press
    const Card* card = nullptr;       ///< the shown card of things to try, if any
    std::span<const Card> cards{};    ///< all cards of the lab
    std::span<const Stroke> drawn{};  ///< the scene's strokes in the last picture

    glm::vec2 screen() const { return {layout.top.max.x, layout.status.max.y}; }
    const Palette& colours() const { return palette(workspace.settings.theme); }
    bool works_here(const Shortcut& shortcut) const {
        return shortcut.lab.empty() || shortcut.lab == workspace.lab;
    }
};

class Shell {
  public:
    void frame(const ShellFrame& frame, Emit& emit);
    /// Rectangles that the last frame drew over the scene: hint, legend and axis gizmo.
    const std::vector<Rect>& overlays() const { return overlays_; }
    /// Scrolls a lab's inspector to its top.
    void show_top(const std::string& lab) { scrolled_[{lab, false}].to_top = true; }
    /// The position of the ring of the card's current step in the last frame, if it was drawn.
    const std::optional<glm::vec2>& card_ring() const { return card_ring_; }

  private:
    void side_panel(const ShellFrame& frame, bool left, Emit& emit);

    float overflow_[2] = {0.0f, 0.0f};  ///< how far each side panel can scroll
    /// A panel's scroll position: the wanted one, and the present one while its content is too short.
    struct Scrolled {
        float wanted = 0.0f, shown = 0.0f, most = 0.0f;
        bool to_top = false;
    };
    void keep_scroll(Scrolled& scrolled);
    std::map<std::pair<std::string, bool>, Scrolled> scrolled_;  ///< by lab, and whether it is the left panel
    std::vector<Rect> overlays_;
    PickId highlighted_ = no_pick;  ///< pick of the highlighted handle; see show_card_halo()
    std::optional<glm::vec2> card_ring_;
    CommandPalette palette_;
    Unfolding unfolding_;
    FileDialog file_dialog_;
};

/// "Undo: move the target": names the change by its command's title; "Undo" if there is none.
std::string undo_title(const CommandTable& commands, const History& history);
std::string redo_title(const CommandTable& commands, const History& history);

// Overlays on the scene.
void show_help(const ShellFrame& frame, Emit& emit);
void show_settings(const ShellFrame& frame, Emit& emit);
void show_recovery(const ShellFrame& frame, Emit& emit);
void show_quit(const ShellFrame& frame, Emit& emit);
/// How to open a file that has several ways.
void show_file_question(const ShellFrame& frame, Emit& emit);
void show_filming(const ShellFrame& frame, Emit& emit);
void show_toasts(const ShellFrame& frame);
/// Returns its rectangle, empty if not shown.
Rect show_first_hint(const ShellFrame& frame);

/// Begins a window in the middle of the screen, of the wanted size in pixels, clamped to fit the
/// screen. Returns false once it is closed by Escape or the cross.
bool begin_sheet(const char* title, glm::vec2 screen, glm::vec2 wanted);

}  // namespace tendril::app
