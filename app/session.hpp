// One run of the program, from its command line's wishes to its exit code.
#pragma once

#include <atomic>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "app/window/window.hpp"

namespace tendril::app {

struct SessionOptions {
    std::string scene;  ///< paths; empty: none
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
};

/// 0 when it ran; 1 when a script's expectation failed or a command of it was refused; 2 when something could
/// not be read, written, known or opened. What is wrong goes to stderr, in one line.
int run_session(const SessionOptions& options);

/// Lets SIGINT and SIGTERM end the session as Ctrl+Q does: cleanly, and with everything written.
void end_session_on_signals();
/// True from then on, for those who run something else than a session.
const std::atomic<bool>& session_ending();

}  // namespace tendril::app
