// `tendril signal`: filters run over the samples of a file.
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

/// Both files are read and checked before anything is written. Stops between two rows, or two kinds of filter
/// that are fitted, once `ending` is set. Throws std::runtime_error where a file cannot be read or is not as
/// signal_help has it, or the output cannot be written.
void run_signal(const SignalOptions& options, const std::atomic<bool>& ending);

/// What it is called on the command line.
extern const char* const signal_subcommand;
/// How the files are written, and which kinds of filter there are, for --help.
std::string signal_help();

}  // namespace tendril::app
