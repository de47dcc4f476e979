// `tendril trace`: finds the faults in a chain's motion that an engine recorded.
#pragma once

#include <optional>
#include <string>

#include "app/io/trace/conventions.hpp"

namespace tendril::app {

struct TraceOptions {
    std::string file;  ///< path; "-" for standard input
    bool json = false, csv = false;
    ConventionChoice conventions;
    std::optional<double> fps{};
};
/// Prints each incident. Returns how many there are. Throws std::runtime_error if nothing can be read, or the
/// output cannot be written.
std::size_t run_trace(const TraceOptions& options);

/// For --help.
extern const char* const trace_help;

}  // namespace tendril::app
