// Runs another program without a shell, writes to its input and checks its exit code.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::app {

/// The path of a program on PATH; empty if it is not installed.
std::filesystem::path find_program(const std::string& name);

/// Errors are std::runtime_error: "<program> failed: <the last line of its stderr>". The destructor kills the
/// program if it is still running.
class ChildProcess {
  public:
    /// Starts `command`, a program's path and its arguments. Its standard output is discarded.
    explicit ChildProcess(const std::vector<std::string>& command);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Writes to its input. Throws if it has ended, or reads nothing for `seconds`.
    void write(std::string_view bytes, double seconds = 30.0);
    /// Closes its input and returns whether it has ended, successfully or not.
    bool ended_after_input();
    /// After it has ended: whether it exited with code 0 and wrote nothing to stderr.
    bool succeeded() const;
    /// Closes its input, waits for at most `seconds`, and throws if it has not succeeded by then.
    void finish(double seconds);

  private:
    class Running;  ///< the operating system's part
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    [[noreturn]] void fail(const std::string& otherwise);
    std::string last_line() const;

    std::string name_;
    std::unique_ptr<std::FILE, CloseFile> complaints_;  ///< its stderr; a pipe could fill up and block it
    std::unique_ptr<Running> running_;
};

}  // namespace tendril::app
