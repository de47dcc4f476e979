// A choice that a lab leaves to the person: kept by name among the settings, shown in their sheet, made by a
// command.
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
        std::string title;  ///< in the settings' sheet
    };
    std::string key;              ///< in the settings' file, and in their sheet
    std::string command;          ///< "view.segments"
    std::string title;            ///< of the command
    std::string argument;         ///< of the command
    std::string help;             ///< of the command
    std::vector<Choice> choices;  ///< two at least; the first is the default

    /// The place in `choices` of what is chosen.
    std::size_t chosen(const Settings& settings) const;
};

/// Chooses what is named, or the next one where nothing is.
Command setting_command(const LabSetting& setting);

}  // namespace tendril::app
