// A choice that a lab leaves to the user: saved by name in the settings, shown in the settings sheet, and
// changed by a command.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tendril::app {

struct Command;
struct Settings;

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

}  // namespace tendril::app
