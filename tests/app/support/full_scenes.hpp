// Scenes in which the panels are full: something is selected, and what can be switched on is on. For tests
// that look at everything a panel can show.
#pragma once

#include <string>
#include <vector>

#include "app/document/command.hpp"
#include "app/labs/lab.hpp"

namespace tendril::test {

/// A scene, and what is selected and switched on in it.
struct Shown {
    std::string name;
    std::vector<app::CommandCall> commands;  ///< from a blank document
    int ticks = 3;                           ///< to let pass
};

app::CommandCall call(const char* name, app::ArgumentList arguments = {});
/// Three bones above each other, the last one "c", and a control "look".
std::vector<app::CommandCall> bones_and_a_control();
/// As it opens, its test scenes, each preset, and one scene for every kind of thing that can be selected.
std::vector<Shown> all_scenes(const app::Lab& lab, const app::CommandTable& table);

}  // namespace tendril::test
