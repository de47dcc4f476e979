// Starts programs as a shell would, above all the built one, and reports how they ended.
#pragma once

#include <signal.h>
#include <sys/types.h>
#include <cmath>
#include <cstdlib>

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "app/io/json_complete.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::test {

/// Variables to set before the program starts; without a value, to unset.
using Environment = std::vector<std::pair<std::string, std::optional<std::string>>>;

struct Outcome {
    int exit_code = -1;  ///< 128 plus the signal if one ended it
    std::string out, err;
    long peak_megabytes = 0;   ///< peak memory
    double cpu_seconds = 0.0;  ///< processor time, which does not depend on other processes
};

/// A process that runs until it ends, or until this object is destroyed.
class Process {
  public:
    explicit Process(const std::vector<std::string>& command, const Environment& changes = {},
                     const std::filesystem::path& folder = {});
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    pid_t id() const { return id_; }
    bool running();
    void signal(int number) const;
    /// Seconds of processor time used so far.
    double cpu_seconds() const;
    /// Its output so far.
    std::string out() const { return read(texts_ / "out"); }
    std::string err() const { return read(texts_ / "err"); }
    /// Waits until it ends; after `seconds`, kills it and fails the test.
    Outcome wait(double seconds = 600.0);

  private:
    bool reap(bool block);

    TempFolder texts_;
    pid_t id_ = -1;
    std::optional<Outcome> outcome_;
};

/// Runs the built program with these arguments, and with an empty config folder whatever the tests'
/// environment is. It starts in `folder`, or in the tests' own.
Outcome run_program(const std::vector<std::string>& arguments, const Environment& changes = {},
                    const std::filesystem::path& folder = {});

/// The same in this process: faster, if no crash must be survived and nothing measured.
Outcome run_here(const std::vector<std::string>& arguments, const std::filesystem::path& folder = {});

/// The command that starts the built program.
std::vector<std::string> program_command(const std::vector<std::string>& arguments);

/// Number of lines in a text, including an unterminated last one.
int count_lines(const std::string& text);

/// Whether a program succeeded: exit code 0 and nothing on stderr.
testing::AssertionResult succeeded(const Outcome& outcome);
/// Whether it ended with that code and a one-line message on stderr that contains all `parts`.
testing::AssertionResult complained(const Outcome& outcome, int exit_code,
                                    const std::vector<std::string>& parts = {});

}  // namespace tendril::test
