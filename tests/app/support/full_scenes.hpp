// Scenes of every lab. Some have full panels: something is selected, and everything that can be switched on is
// on, for tests that check everything a panel can show.
#pragma once

#include "app/document/command.hpp"
#include "app/labs/lab.hpp"

namespace tendril::test {

/// A starting scene for tests that run over every lab: they send it random events and commands, and a replay
/// must end in the same state. Small scenes also seed the scene fuzzer.
struct TestScene {
    std::string name;
    std::vector<app::CommandCall> commands;  ///< set it up from a blank document
    std::vector<std::string> words;          ///< names that exist here, for commands that take any text
};

std::vector<TestScene> test_scenes(const app::Lab& lab);

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
std::vector<Shown> all_scenes(const app::Lab& lab);

}  // namespace tendril::test
