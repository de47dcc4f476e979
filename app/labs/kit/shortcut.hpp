// A row of the table of keys, as the shell and the labs declare it.
#pragma once

#include <string>

#include "app/document/argument_list.hpp"
#include "app/window/keys.hpp"

namespace tendril::app {

struct Shortcut {
    Chord chord;
    std::string command;
    ArgumentList arguments{};
    std::string title;    ///< as the menu has it; empty: the command's own
    std::string section;  ///< of the menu and the help: "Edit"; a lab may add sections of its own
    bool in_menu = true;
    bool while_typing = false;  ///< works although a text field has the keyboard
    bool repeats = false;       ///< goes on while the key is held
    std::string lab{};          ///< works in this lab alone; empty: in all of them
};

/// Delete, as every lab in which something can be selected has it.
inline Shortcut delete_shortcut(const char* command) {
    return {*chord_from_name("delete"), command, {}, "", "Edit"};
}

/// What the mouse does: a row of the help.
struct MouseHelp {
    std::string gesture, effect;
};

}  // namespace tendril::app
