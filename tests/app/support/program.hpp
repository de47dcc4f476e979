// Starts programs as a person's shell would, the built one above all, and says what came of them.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/support/temp_folder.hpp"

namespace tendril::test {

/// Variables to set, or with no value to unset, before the program starts.
using Environment = std::vector<std::pair<std::string, std::optional<std::string>>>;

struct Outcome {
    int exit_code = -1;  ///< 128 plus the signal where one ended it
    std::string out, err;
    long peak_megabytes = 0;  ///< of memory held at once
    double seconds = 0.0;     ///< by the clock
};

/// A process that runs until it ends, or until this object does.
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
    /// What it has said so far.
    std::string out() const { return read(texts_ / "out"); }
    std::string err() const { return read(texts_ / "err"); }
    /// Waits for its end; kills it, and fails the test, when that takes longer than `seconds`.
    Outcome wait(double seconds = 60.0);

  private:
    bool reap(bool block);

    TempFolder texts_;
    pid_t id_ = -1;
    double started_ = 0.0;
    std::optional<Outcome> outcome_;
};

/// The built program with these arguments. Whatever the tests' own surroundings are, it finds an empty config
/// folder. It starts in `folder`, or where the tests do.
Outcome run_program(const std::vector<std::string>& arguments, const Environment& changes = {},
                    const std::filesystem::path& folder = {});

/// The same in this very process, which is quicker where nothing has to be survived or measured.
Outcome run_here(const std::vector<std::string>& arguments, const std::filesystem::path& folder = {});

/// The command that starts the built program.
std::vector<std::string> program_command(const std::vector<std::string>& arguments);

/// Lines in a text, the last one counted whether or not it ends.
int count_lines(const std::string& text);

/// Whether a program found no fault: exit code 0 and nothing on stderr.
testing::AssertionResult succeeded(const Outcome& outcome);
/// Whether it ended with that code and said why in a single line of stderr that has all of `parts`.
testing::AssertionResult complained(const Outcome& outcome, int exit_code,
                                    const std::vector<std::string>& parts = {});

/// Sanitizers take time and memory of their own: limits are multiplied by this.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr int sanitizer_factor = 6;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr int sanitizer_factor = 6;
#else
inline constexpr int sanitizer_factor = 1;
#endif
#else
inline constexpr int sanitizer_factor = 1;
#endif

}  // namespace tendril::test
