// Runs the program by its arguments: a session with a window or off screen, a list, or a subcommand.
#pragma once

#include <string>
#include <vector>

namespace tendril::app {

/// `words` begin with the program's name. Returns the program's exit code: run_session's or the subcommand's,
/// or 2 for an invalid command line. Errors are printed to stderr, in one line.
int run_command_line(const std::vector<std::string>& words);

}  // namespace tendril::app
