// A lab's rows in the shell's tables: user settings, keys and mouse gestures.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/document/argument_list.hpp"
#include "app/window/keys.hpp"

namespace tendril::app {

struct Command;
struct Settings;

/// A choice that a lab leaves to the user: saved by name in the settings, shown in the settings sheet, and
/// changed by a command.
struct LabSetting {
    struct Choice {
        std::string name;   ///< in files and commands
        std::string title;  ///< in the settings sheet
    };
    std::string key;              ///< in the settings file and sheet
    std::string command;          ///< "view.segments"
    std::string title;            ///< the command's title
    std::string argument;         ///< the command's argument
    std::string help;             ///< the command's help
    std::vector<Choice> choices;  ///< at least two; the first is the default

    /// The index in `choices` of the present choice.
    std::size_t chosen(const Settings& settings) const;
};

/// Selects the named choice, or the next one if none is named.
Command setting_command(const LabSetting& setting);

// Rows of the tables of keys and mouse gestures that the shell and the labs declare.

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
