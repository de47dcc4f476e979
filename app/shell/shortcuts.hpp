// The single table of keys and mouse gestures: the shell's rows, every lab's, and the camera's as the user
// chose them. The handlers, the menu, the help overlay, the tooltips and the README's list all come from it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/settings.hpp"
#include "app/labs/kit/setting.hpp"
#include "app/labs/labs.hpp"
#include "app/window/event.hpp"

namespace tendril::app {

// Mouse bindings for the camera: Tendril's own, or the ones a user knows from another program.

enum class MousePreset { Tendril, Blender, Maya };
MousePreset mouse_preset(const Settings& settings);

/// The effect of the wheel, or two fingers on a touchpad, in the view. Pan: they zoom while Ctrl is held.
enum class Scroll { Zoom, Pan };
Scroll scroll_action(const Settings& settings);

enum class MouseAction { Orbit, Pan, Zoom };
struct HeldKeys {
    bool shift = false, ctrl = false, alt = false;
    bool operator==(const HeldKeys&) const = default;
};
/// The effect of a drag with that button; none if it acts on handles. A left drag that begins on empty space
/// orbits, in every preset.
std::optional<MouseAction> mouse_action(MousePreset preset, MouseButton button, HeldKeys held);

/// "Right-drag turns the view, middle-drag shifts it, the wheel zooms. ? shows every key." A brief one leaves
/// out how to shift and zoom.
std::string view_hint(const Settings& settings, bool by_finger, bool brief = false);

class CommandTable;

class Shortcuts {
  public:
    /// A lab's rows follow the others of their section; its own sections come before the last one, *Help*. A
    /// row without a title gets its command's.
    Shortcuts(const Labs& labs, const CommandTable& commands);

    /// A row with the same title as an earlier one is another key for it.
    const std::vector<Shortcut>& all() const { return rows_; }
    /// The shortcut of that key in a lab; null if there is none.
    const Shortcut* find(const Chord& chord, std::string_view lab) const;
    /// "Ctrl+Z", of the first row with that command; empty if it has no key.
    std::string keys_for(std::string_view command) const;
    /// "Ctrl+Shift+Z, Ctrl+Y": every key that does the same.
    std::string all_keys_for(const Shortcut& wanted) const;
    /// Mouse gestures common to all labs, then those of the named lab; of every lab if the name is empty.
    std::vector<MouseHelp> mouse_help(std::string_view lab = {}, MousePreset preset = MousePreset::Tendril,
                                      Scroll scroll = Scroll::Zoom) const;
    /// Both lists as Markdown tables, for the README.
    std::string markdown() const;

  private:
    void add(Shortcut row);

    struct LabHelp {
        std::string lab;
        std::vector<MouseHelp> rows;
    };
    std::vector<Shortcut> rows_;
    std::vector<LabHelp> mouse_;
};

}  // namespace tendril::app
