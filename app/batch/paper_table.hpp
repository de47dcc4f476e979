// `tendril paper`: the rows of paper.hpp, printed as they are measured.
#pragma once

#include <atomic>

namespace tendril::app {

/// Prints a readable table, or CSV. Stops once `ending` is set and keeps the finished rows. Throws
/// std::runtime_error if the output cannot be written.
void print_paper(bool csv, const std::atomic<bool>& ending);

/// For --help.
extern const char* const paper_help;

}  // namespace tendril::app
