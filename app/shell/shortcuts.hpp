// The one table of keys and of what the mouse does. The handlers, the menu, the help overlay, the tooltips
// and the README's list all come from it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/argument_list.hpp"
#include "app/window/event.hpp"

namespace tendril::app {

enum class Section { Scene, Edit, View, Time, Microscope, Help };
const char* section_title(Section section);

struct Shortcut {
    Chord chord;
    std::string command;
    ArgumentList arguments{};
    std::string title;  ///< as the menu has it
    Section section = Section::View;
    bool in_menu = true;
    bool while_typing = false;  ///< works although a text field has the keyboard
    bool repeats = false;       ///< goes on while the key is held
    std::string lab{};          ///< works in this lab alone; empty: in all of them
};

/// A row with the same command as an earlier one is another key for it.
const std::vector<Shortcut>& shortcuts();
/// Of that key in a lab.
const Shortcut* find_shortcut(const Chord& chord, std::string_view lab);
/// "Ctrl+Z", of the first row with that command; empty where it has no key.
std::string keys_for(std::string_view command);

enum class MouseAction { Orbit, Pan };

/// A drag of the mouse through the empty view, or over anything.
struct MouseBinding {
    MouseButton button;
    bool shift, alt;
    MouseAction action;
};
std::optional<MouseAction> mouse_action(MouseButton button, bool shift, bool alt);

/// "Ctrl+Shift+Z, Ctrl+Y": every key that does the same.
std::string all_keys_for(const Shortcut& wanted);

/// What the mouse does, as the help and the README list it.
struct MouseHelp {
    std::string gesture, effect;
};
const std::vector<MouseHelp>& mouse_help();

/// Both lists as Markdown tables, as they stand in the README.
std::string shortcuts_markdown();

}  // namespace tendril::app
