// One run of the program, from its arguments to its exit code, and the scene that a window opens with.
#pragma once

#include <atomic>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/window/window.hpp"

namespace tendril::app {

class App;

struct SessionOptions {
    std::string scene;  ///< a scene, or another file that a lab reads; empty: none
    std::string lab;
    std::optional<glm::ivec2> size;
    bool headless = false;
    std::optional<Backend> backend;
    std::string script;
    std::optional<int> frames;
    std::string screenshot;
    std::string state;
    std::string record;
    bool config = true;
    bool force = false;  ///< replaces existing files, as Outputs describes
};

/// Returns 0 on success; 1 if a script's expectation failed or one of its commands was refused; 2 if
/// something could not be read, written or opened, or does not exist. Errors go to stderr, in one line.
int run_session(const SessionOptions& options);

/// Makes SIGINT, SIGTERM and SIGHUP end the session cleanly, with all outputs written.
void end_session_on_signals();
/// Makes them end the program at once, for commands that write all output at the end.
void end_at_once_on_signals();
/// True after a signal to end the session, for code outside a session.
const std::atomic<bool>& session_ending();

// Runs the program by its arguments: a session with a window or off screen, a list, or a subcommand.

/// `words` begin with the program's name. Returns the program's exit code: run_session's or the subcommand's,
/// or 2 for an invalid command line. Errors are printed to stderr, in one line.
int run_command_line(const std::vector<std::string>& words);

// The scene that a window opens with: it moves, and has cards of things to try.

/// Opens the session's scene and lab, or the scene below. False if part of it could not be read; throws
/// std::runtime_error if it cannot be opened.
bool open_scene(App& app, const SessionOptions& options);
/// True if the session has a window and was given no scene, lab or script.
bool opens_alive(const SessionOptions& options);
/// Sets up every lab's opening as a new scene: nothing to undo, nothing to save. The openings move by
/// themselves until the user takes over (Lab::calm()), which does not mark the scene as modified.
void open_alive(App& app);
/// Shows each lab's card unless it was shown or hidden before.
void offer_cards(App& app);

}  // namespace tendril::app
