// `tendril paper`: the rows of paper.hpp, printed as they are measured.
#pragma once

#include <atomic>

namespace tendril::app {

/// For people, or as CSV. Stops once `ending` is set: the rows that are done stay. Throws std::runtime_error
/// where the output cannot be written.
void print_paper(bool csv, const std::atomic<bool>& ending);

/// What is measured, and what is not, for --help.
extern const char* const paper_help;

}  // namespace tendril::app
