// Rows of the tables of keys and mouse gestures that the shell and the labs declare.
#pragma once

#include <string>

#include "app/document/argument_list.hpp"
#include "app/window/keys.hpp"

namespace tendril::app {

struct Shortcut {
    Chord chord;
    std::string command;
    ArgumentList arguments{};
    std::string title;    ///< in the menu; empty: the command's own
    std::string section;  ///< section of the menu and the help: "Edit"; a lab may add sections of its own
    bool in_menu = true;
    bool while_typing = false;  ///< works even while a text field has the focus
    bool repeats = false;       ///< repeats while the key is held
    std::string lab{};          ///< works in this lab only; empty: in all labs
};

/// The Delete key, for labs with a selection.
inline Shortcut delete_shortcut(const char* command) {
    return {*chord_from_name("delete"), command, {}, "", "Edit"};
}

/// A mouse gesture, as a row of the help.
struct MouseHelp {
    std::string gesture, effect;
};

}  // namespace tendril::app
