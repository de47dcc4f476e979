// `tendril signal`: runs filters over the samples of a file, or fits them.
#pragma once

#include <atomic>
#include <string>

namespace tendril::app {

struct SignalOptions {
    std::string filters;  ///< path of FILTER.json
    std::string samples;  ///< path of SAMPLES.csv
    bool rates = false;   ///< one output for each frame rate
    std::string fit;      ///< path of RESPONSE.csv; empty: nothing is fitted
};

/// Reads and checks all files before writing anything. Stops between two rows, or two fitted kinds of filter,
/// once `ending` is set. Throws std::runtime_error if a file cannot be read or does not match signal_help, or
/// the output cannot be written.
void run_signal(const SignalOptions& options, const std::atomic<bool>& ending);

/// The subcommand's name.
extern const char* const signal_subcommand;
/// Describes the file formats and the kinds of filter, for --help.
std::string signal_help();

}  // namespace tendril::app
