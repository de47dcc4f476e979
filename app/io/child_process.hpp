// Another program, run without a shell: given bytes, and asked whether all went well.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::app {

/// Where a program of this name is found on PATH; empty where it is not installed.
std::filesystem::path find_program(const std::string& name);

/// All that throws does so with std::runtime_error: "<program> failed: <the last line it complained with>".
/// The program still runs when this is destroyed: then it is killed.
class ChildProcess {
  public:
    /// Starts `command`, a program's path and its arguments. What it prints is dropped.
    explicit ChildProcess(const std::vector<std::string>& command);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Gives it bytes to read. Throws where it ended before, or takes none for `seconds`.
    void write(std::string_view bytes, double seconds = 30.0);
    /// No more bytes come: whether it has ended, well or not.
    bool ended_after_input();
    /// The same, but waits `seconds` at most, and throws where it has not ended by then, or not well.
    void finish(double seconds);

  private:
    [[noreturn]] void fail(const std::string& otherwise);
    void close_input();
    bool ended();
    std::string last_line() const;

    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string name_;
    std::unique_ptr<std::FILE, CloseFile> complaints_;  ///< a file, as a full pipe would stop the program
    int input_ = -1;
    pid_t id_ = -1;  ///< -1 once it has ended
    int status_ = 0;
};

}  // namespace tendril::app
