// What the program does with its arguments: a session with a window or a picture, a list, or work without
// either.
#pragma once

namespace tendril::app {

/// The program's exit code: 0, what run_session or a subcommand says, or 2 for a line that is none. What is
/// wrong goes to stderr, in one line.
int run_command_line(int argc, const char* const* argv);

}  // namespace tendril::app
