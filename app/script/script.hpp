// Scripts: JSON lines, one object to a line, parsed whole before anything runs. A recording is a script whose
// first line says what it started from.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/document/expectation.hpp"
#include "app/document/json.hpp"
#include "app/window/event.hpp"

namespace tendril::app {

class CommandTable;

struct RunCommand {
    std::string name;
    SharedJson arguments{};
    bool expect_refusal = false;
};
/// The mouse goes to where a handle is seen, or so many pixels from there.
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
/// Runs within the tick it takes; commands, screenshots, states and expectations take none.
using Action = std::variant<Event, MoveToHandle, RunCommand, Wait, TakeScreenshot, WriteState, Expect>;

struct ScriptLine {
    int number = 0;  ///< in the file, from 1
    Action action;
};

inline constexpr int recording_version = 1;
inline constexpr int max_wait_ticks = 1'000'000;
inline constexpr int max_window_side = 16384;

/// A recording's first line: what it started from.
struct RecordingStart {
    std::string version;  ///< of the program that wrote it
    glm::ivec2 size{0};
    std::string lab;
    SharedJson scene;
    SharedJson settings;
    std::string path{};     ///< the scene's file, empty while it had none
    bool modified = false;  ///< it had changes that were not saved
    float scale = 1.0f;     ///< the window's own wish for the size of text and widgets
    bool live = false;      ///< made in a window: of what another program does the end is an event
};

struct Script {
    std::optional<RecordingStart> start;
    std::vector<ScriptLine> lines;
};

/// Throws std::runtime_error, "line 7: <reason>", for a line that is not JSON, not one of the known forms, of
/// a wrong type, has a member too many, or names a command that the table does not have. Blank lines are
/// skipped. A command's own arguments are checked when it runs.
Script parse_script(std::string_view text, const CommandTable& commands);

}  // namespace tendril::app
