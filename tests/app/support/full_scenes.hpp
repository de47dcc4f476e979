// Scenes with full panels: something is selected, and everything that can be switched on is on. For tests
// that check everything a panel can show.
#pragma once

#include "app/document/command.hpp"
#include "app/labs/lab.hpp"

namespace tendril::test {

/// A scene with its selection and switches.
struct Shown {
    std::string name;
    std::vector<app::CommandCall> commands;  ///< set it up from a blank document
    int ticks = 3;                           ///< ticks to run
};

app::CommandCall call(const char* name, app::ArgumentList arguments = {});
/// Three bones in a column, the last one "c", and a control "look".
std::vector<app::CommandCall> bones_and_a_control();
/// Its opening, its test scenes, each preset, and one scene for every kind of selectable object.
std::vector<Shown> all_scenes(const app::Lab& lab, const app::CommandTable& table);

}  // namespace tendril::test
