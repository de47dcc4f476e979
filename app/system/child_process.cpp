#include "app/system/child_process.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "app/system/environment.hpp"

#ifdef _WIN32
#include <windows.h>

#include <fcntl.h>
#include <io.h>

#include <atomic>
#else
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

extern char** environ;
#endif

namespace tendril::app {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds look_again{2};

enum class Written { All, Ended, Stuck };

#ifdef _WIN32
constexpr char path_separator = ';';
constexpr const char* program_ending = ".exe";

bool can_run(const fs::path&) {
    return true;
}

[[noreturn]] void fail_to_start(const std::string& name) {
    const std::error_code why(static_cast<int>(::GetLastError()), std::system_category());
    throw std::runtime_error("cannot start " + name + ": " + why.message());
}

std::wstring wide(const std::string& text) {
    return fs::path(text).wstring();
}

/// Quotes words the way the other program's C runtime splits them: backslashes count only before a quotation
/// mark.
std::wstring command_line(const std::vector<std::string>& words) {
    std::wstring line;
    for (const std::string& word : words) {
        line += line.empty() ? L"\"" : L" \"";
        std::size_t slashes = 0;
        for (const wchar_t each : wide(word)) {
            if (each == L'"') line.append(slashes + 1, L'\\');
            slashes = each == L'\\' ? slashes + 1 : 0;
            line += each;
        }
        line.append(slashes, L'\\') += L'"';
    }
    return line;
}

/// A file that is deleted when it is closed; a child may inherit it.
std::FILE* open_complaints() {
    wchar_t folder[MAX_PATH + 1] = L"", name[MAX_PATH + 1] = L"";
    if (::GetTempPathW(MAX_PATH, folder) == 0 || ::GetTempFileNameW(folder, L"ten", 0, name) == 0)
        return nullptr;
    SECURITY_ATTRIBUTES inherited{sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
    const HANDLE handle =
        ::CreateFileW(name, GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, &inherited,
                      CREATE_ALWAYS, FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
    if (handle == INVALID_HANDLE_VALUE) return nullptr;
    return ::_fdopen(::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_RDWR | _O_BINARY), "w+b");
}

}  // namespace

class ChildProcess::Running {
  public:
    Running(const std::string& name, const std::vector<std::string>& command, std::FILE* complaints) {
        SECURITY_ATTRIBUTES inherited{sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
        HANDLE reads = nullptr;
        if (complaints == nullptr || ::CreatePipe(&reads, &input_, &inherited, 1 << 16) == 0)
            fail_to_start(name);
        ::SetHandleInformation(input_, HANDLE_FLAG_INHERIT, 0);
        const HANDLE nowhere = ::CreateFileW(L"NUL", GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE,
                                             &inherited, OPEN_EXISTING, 0, nullptr);
        STARTUPINFOW start{};
        start.cb = sizeof start;
        start.dwFlags = STARTF_USESTDHANDLES;
        start.hStdInput = reads;
        start.hStdOutput = nowhere;
        start.hStdError = reinterpret_cast<HANDLE>(::_get_osfhandle(::_fileno(complaints)));
        PROCESS_INFORMATION made{};
        std::wstring line = command_line(command);
        const bool started = ::CreateProcessW(wide(command.front()).c_str(), line.data(), nullptr, nullptr,
                                              TRUE, CREATE_NO_WINDOW, nullptr, nullptr, &start, &made) != 0;
        const DWORD why = ::GetLastError();
        ::CloseHandle(reads);
        ::CloseHandle(nowhere);
        if (!started) {
            close_input();
            ::SetLastError(why);
            fail_to_start(name);
        }
        ::CloseHandle(made.hThread);
        process_ = made.hProcess;
    }
    ~Running() {
        close_input();
        if (!ended()) {
            ::TerminateProcess(process_, 1);
            constexpr DWORD patience = 5000;  // ms to wait until its files are closed
            ::WaitForSingleObject(process_, patience);
        }
        ::CloseHandle(process_);
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    void close_input() {
        if (input_ != nullptr) ::CloseHandle(std::exchange(input_, nullptr));
    }
    /// A full pipe blocks the writing thread, so another one writes, and ending the child frees it.
    Written write(std::string_view bytes, double seconds) {
        std::atomic<bool> well{true};
        std::atomic<std::size_t> written{0};
        std::thread writer([&, bytes]() mutable {
            while (!bytes.empty() && well) {
                DWORD count = 0;
                const auto piece = static_cast<DWORD>(std::min<std::size_t>(bytes.size(), 1 << 16));
                well = ::WriteFile(input_, bytes.data(), piece, &count, nullptr) != 0;
                bytes.remove_prefix(count);
                written += count;
            }
        });
        using Time = std::chrono::steady_clock;
        auto seen = Time::now();
        std::size_t before = 0;
        Written result = Written::All;
        while (well && written < bytes.size()) {
            if (written != before) seen = Time::now(), before = written;
            if (Time::now() - seen > std::chrono::duration<double>(seconds)) {
                result = Written::Stuck;
                ::TerminateProcess(process_, 1);
                break;
            }
            ::WaitForSingleObject(process_, 1);
            std::this_thread::yield();
        }
        writer.join();
        return result == Written::All && !well ? Written::Ended : result;
    }
    bool ended() const { return ::WaitForSingleObject(process_, 0) == WAIT_OBJECT_0; }
    std::string failure() const {
        DWORD code = 0;
        ::GetExitCodeProcess(process_, &code);
        return code == 0 ? std::string() : "exit code " + std::to_string(static_cast<int>(code));
    }

  private:
    HANDLE input_ = nullptr, process_ = nullptr;
};

#else
constexpr char path_separator = ':';
constexpr const char* program_ending = "";

bool can_run(const fs::path& file) {
    return ::access(file.c_str(), X_OK) == 0;
}

[[noreturn]] void fail_to_start(const std::string& name, int why) {
    throw std::runtime_error("cannot start " + name + ": " + std::generic_category().message(why));
}

std::FILE* open_complaints() {
    return std::tmpfile();
}

/// Blocks SIGPIPE during its lifetime and consumes one that was raised: writing to a program that has ended
/// would otherwise end this one.
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

class ChildProcess::Running {
  public:
    Running(const std::string& name, const std::vector<std::string>& command, std::FILE* complaints) {
        std::array<int, 2> ends{-1, -1};
        if (complaints == nullptr || ::pipe2(ends.data(), O_CLOEXEC) != 0) fail_to_start(name, errno);
        ::fcntl(::fileno(complaints), F_SETFD, FD_CLOEXEC);
        const int error = SpawnPlan(ends[0], ::fileno(complaints)).start(id_, command);
        ::close(ends[0]);
        input_ = ends[1];
        ::fcntl(input_, F_SETFL, O_NONBLOCK);
        if (error == 0) return;
        close_input();
        fail_to_start(name, error);
    }
    ~Running() {
        close_input();
        if (id_ < 0) return;
        ::kill(id_, SIGKILL);
        while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    void close_input() {
        if (input_ >= 0) ::close(std::exchange(input_, -1));
    }
    Written write(std::string_view bytes, double seconds) {
        const HeldSigpipe held;
        while (!bytes.empty()) {
            const ssize_t count = ::write(input_, bytes.data(), bytes.size());
            if (count > 0) {
                bytes.remove_prefix(static_cast<std::size_t>(count));
            } else if (errno == EAGAIN) {
                struct pollfd wanted {};
                wanted.fd = input_;
                wanted.events = POLLOUT;
                if (::poll(&wanted, 1, static_cast<int>(1000.0 * seconds)) == 0) return Written::Stuck;
            } else if (errno != EINTR) {
                return Written::Ended;
            }
        }
        return Written::All;
    }
    bool ended() {
        if (id_ < 0) return true;
        if (::waitpid(id_, &status_, WNOHANG) != id_) return false;
        id_ = -1;
        return true;
    }
    /// Once it has ended: why it failed; empty if it succeeded.
    std::string failure() const {
        if (WIFSIGNALED(status_)) return "signal " + std::to_string(WTERMSIG(status_)) + " ended it";
        const int code = WEXITSTATUS(status_);
        return code == 0 ? std::string() : "exit code " + std::to_string(code);
    }

  private:
    int input_ = -1;
    pid_t id_ = -1;  ///< -1 once it has ended
    int status_ = 0;
};
#endif

fs::path find_program(const std::string& name) {
    const std::string all = environment_variable("PATH");
    std::string_view rest = all;
    while (!rest.empty()) {
        const auto end = std::min(rest.find(path_separator), rest.size());
        const fs::path file = fs::path(rest.substr(0, end)) / (name + program_ending);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        std::error_code error;
        if (fs::is_regular_file(file, error) && can_run(file)) return file;
    }
    return {};
}

ChildProcess::ChildProcess(const std::vector<std::string>& command)
    : name_(fs::path(command.front()).filename().string()),
      complaints_(open_complaints()),
      running_(std::make_unique<Running>(name_, command, complaints_.get())) {}

ChildProcess::~ChildProcess() = default;

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
    running_->close_input();
    // The program may have closed its input before it reports why: wait for up to a second.
    using Time = std::chrono::steady_clock;
    for (const auto end = Time::now() + std::chrono::seconds(1); !running_->ended() && Time::now() < end;)
        std::this_thread::sleep_for(look_again);
    const std::string line = last_line();
    throw std::runtime_error(name_ + " failed: " + (line.empty() ? otherwise : line));
}

void ChildProcess::write(std::string_view bytes, double seconds) {
    const Written written = running_->write(bytes, seconds);
    if (written == Written::Stuck) fail("it stopped reading its input");
    if (written == Written::Ended) fail("it exited too early");
}

bool ChildProcess::ended_after_input() {
    running_->close_input();
    return running_->ended();
}

bool ChildProcess::succeeded() const {
    return running_->failure().empty() && last_line().empty();
}

void ChildProcess::finish(double seconds) {
    using Time = std::chrono::steady_clock;
    const auto end = Time::now() + std::chrono::duration<double>(seconds);
    while (!ended_after_input()) {
        if (Time::now() >= end) fail("it did not exit");
        std::this_thread::sleep_for(look_again);
    }
    if (!succeeded()) fail(running_->failure());
}

}  // namespace tendril::app
