// Runs the program by its arguments: a session with a window or off screen, a list, or a subcommand.
#pragma once

namespace tendril::app {

/// Returns the program's exit code: run_session's or the subcommand's, or 2 for an invalid command line.
/// Errors are printed to stderr, in one line.
int run_command_line(int argc, const char* const* argv);

}  // namespace tendril::app
