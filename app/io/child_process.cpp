#include "app/io/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

extern char** environ;

namespace tendril::app {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds look_again{2};

std::string last_error() {
    return std::generic_category().message(errno);
}

/// Blocks SIGPIPE while it lives and consumes one that was raised: writing to a program that has ended would
/// otherwise end this one.
class HeldSigpipe {
  public:
    HeldSigpipe() {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        was_pending_ = pending();
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~HeldSigpipe() {
        int taken = 0;
        if (!was_pending_ && pending()) sigwait(&pipe_, &taken);
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    HeldSigpipe(const HeldSigpipe&) = delete;
    HeldSigpipe& operator=(const HeldSigpipe&) = delete;

  private:
    static bool pending() {
        sigset_t set;
        sigpending(&set);
        return sigismember(&set, SIGPIPE) == 1;
    }
    sigset_t pipe_{}, before_{};
    bool was_pending_ = false;
};

/// How a program starts: its input, no output, its errors in a file, and no blocked signals.
class SpawnPlan {
  public:
    SpawnPlan(int input, int complaints) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions_, complaints, STDERR_FILENO);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawnattr_init(&attributes_);
        sigset_t none, usual;
        sigemptyset(&none);
        sigemptyset(&usual);
        for (const int each : {SIGPIPE, SIGINT, SIGTERM}) sigaddset(&usual, each);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setsigdefault(&attributes_, &usual);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    }
    ~SpawnPlan() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;

    /// Starts the program. Returns 0 or an errno value.
    int start(pid_t& id, const std::vector<std::string>& command) const {
        std::vector<char*> words;
        for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
        words.push_back(nullptr);
        return ::posix_spawn(&id, words.front(), &actions_, &attributes_, words.data(), environ);
    }

  private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

}  // namespace

fs::path find_program(const std::string& name) {
    const char* const all = std::getenv("PATH");
    std::string_view rest = all != nullptr ? all : "";
    while (!rest.empty()) {
        const auto end = std::min(rest.find(':'), rest.size());
        const fs::path file = fs::path(rest.substr(0, end)) / name;
        rest.remove_prefix(std::min(end + 1, rest.size()));
        std::error_code error;
        if (fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0) return file;
    }
    return {};
}

ChildProcess::ChildProcess(const std::vector<std::string>& command)
    : name_(fs::path(command.front()).filename().string()), complaints_(std::tmpfile()) {
    std::array<int, 2> ends{-1, -1};
    if (!complaints_ || ::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::runtime_error("cannot start " + name_ + ": " + last_error());
    const int complaints = ::fileno(complaints_.get());
    ::fcntl(complaints, F_SETFD, FD_CLOEXEC);
    const int error = SpawnPlan(ends[0], complaints).start(id_, command);
    ::close(ends[0]);
    input_ = ends[1];
    ::fcntl(input_, F_SETFL, O_NONBLOCK);
    if (error == 0) return;
    id_ = -1;
    close_input();
    throw std::runtime_error("cannot start " + name_ + ": " + std::generic_category().message(error));
}

ChildProcess::~ChildProcess() {
    close_input();
    if (id_ < 0) return;
    ::kill(id_, SIGKILL);
    while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void ChildProcess::close_input() {
    if (input_ >= 0) ::close(std::exchange(input_, -1));
}

bool ChildProcess::ended() {
    if (id_ < 0) return true;
    if (::waitpid(id_, &status_, WNOHANG) != id_) return false;
    id_ = -1;
    return true;
}

std::string ChildProcess::last_line() const {
    constexpr long most = 4096;
    std::FILE* const file = complaints_.get();
    std::fseek(file, 0, SEEK_END);
    const long size = std::ftell(file);
    std::string text(static_cast<std::size_t>(std::clamp(size, 0L, most)), '\0');
    std::fseek(file, std::max(0L, size - most), SEEK_SET);
    text.resize(std::fread(text.data(), 1, text.size(), file));
    text.erase(text.find_last_not_of(" \r\n") + 1);
    const auto begin = text.find_last_of("\r\n");
    return begin == text.npos ? text : text.substr(begin + 1);
}

void ChildProcess::fail(const std::string& otherwise) {
    close_input();
    // The program may have closed its input before it reports why: wait for up to a second.
    using Time = std::chrono::steady_clock;
    for (const auto end = Time::now() + std::chrono::seconds(1); !ended() && Time::now() < end;)
        std::this_thread::sleep_for(look_again);
    const std::string line = last_line();
    throw std::runtime_error(name_ + " failed: " + (line.empty() ? otherwise : line));
}

void ChildProcess::write(std::string_view bytes, double seconds) {
    const HeldSigpipe held;
    while (!bytes.empty()) {
        const ssize_t count = ::write(input_, bytes.data(), bytes.size());
        if (count > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(count));
        } else if (errno == EAGAIN) {
            struct pollfd wanted {};
            wanted.fd = input_;
            wanted.events = POLLOUT;
            if (::poll(&wanted, 1, static_cast<int>(1000.0 * seconds)) == 0)
                fail("it stopped reading its input");
        } else if (errno != EINTR) {
            fail("it exited too early");
        }
    }
}

bool ChildProcess::ended_after_input() {
    close_input();
    return ended();
}

bool ChildProcess::succeeded() const {
    return WIFEXITED(status_) && WEXITSTATUS(status_) == 0 && last_line().empty();
}

void ChildProcess::finish(double seconds) {
    using Time = std::chrono::steady_clock;
    const auto end = Time::now() + std::chrono::duration<double>(seconds);
    while (!ended_after_input()) {
        if (Time::now() >= end) fail("it did not exit");
        std::this_thread::sleep_for(look_again);
    }
    if (WIFSIGNALED(status_)) fail("signal " + std::to_string(WTERMSIG(status_)) + " ended it");
    if (!succeeded()) fail("exit code " + std::to_string(WEXITSTATUS(status_)));
}

}  // namespace tendril::app
