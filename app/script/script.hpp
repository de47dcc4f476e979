// Scripts: JSON lines, one object per line, parsed completely before anything runs. A recording is a script
// whose first line contains the initial state.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/document/expectation.hpp"
#include "app/io/json.hpp"
#include "app/window/event.hpp"

namespace tendril::app {

class CommandTable;

struct RunCommand {
    std::string name;
    SharedJson arguments{};
    bool expect_refusal = false;
};
/// Moves the mouse to a handle's pixel, plus an offset in pixels.
struct MoveToHandle {
    std::string handle;
    glm::vec2 offset{0.0f};
};
struct Wait {
    int ticks = 0;
};
struct TakeScreenshot {
    std::string path;
};
struct WriteState {
    std::string path;
};
/// Events and moves take one tick, Wait its number of ticks; commands, screenshots, states and expectations
/// take none.
using Action = std::variant<Event, MoveToHandle, RunCommand, Wait, TakeScreenshot, WriteState, Expect>;

struct ScriptLine {
    int number = 0;  ///< in the file, from 1
    Action action;
};

inline constexpr int recording_version = 1;
inline constexpr int max_wait_ticks = 1'000'000;
inline constexpr int max_window_side = 16384;

/// A recording's first line: its initial state.
struct RecordingStart {
    std::string version;  ///< the version of the program that wrote it
    glm::ivec2 size{0};
    std::string lab;
    SharedJson scene;
    SharedJson settings;
    std::string path{};     ///< the scene's file, empty if none
    bool modified = false;  ///< it had unsaved changes
    float scale = 1.0f;     ///< the window's own scale for text and widgets
    bool live = false;      ///< recorded in a window, where a child process's end is an event
    int line = 1;           ///< its line in the script
};

struct Script {
    std::optional<RecordingStart> start;
    std::vector<ScriptLine> lines;
};

/// Throws std::runtime_error, "line 7: <reason>", for a line that is not JSON, has an unknown form, a wrong
/// type or an unknown member, or names an unknown command. Blank lines are skipped. A command's own arguments
/// are checked only when it runs.
Script parse_script(std::string_view text, const CommandTable& commands);

}  // namespace tendril::app
