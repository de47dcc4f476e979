#include "tests/app/support/program.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/session.hpp"

namespace tendril::test {
namespace {

double now() {
    using Clock = std::chrono::steady_clock;
    return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

void redirect(const std::filesystem::path& path, int descriptor, int flags) {
    const int file = ::open(path.c_str(), flags, 0600);
    if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(126);
    ::close(file);
}

/// Runs in the child, which becomes the program.
[[noreturn]] void become(const std::vector<std::string>& command, const Environment& changes,
                         const std::filesystem::path& folder, const TempFolder& texts) {
    redirect("/dev/null", 0, O_RDONLY);
    redirect(texts / "out", 1, O_WRONLY | O_CREAT | O_TRUNC);
    redirect(texts / "err", 2, O_WRONLY | O_CREAT | O_TRUNC);
    for (const auto& [name, value] : changes)
        value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
    if (!folder.empty() && ::chdir(folder.c_str()) != 0) ::_exit(126);
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    ::execvp(words.front(), words.data());
    ::_exit(127);
}

}  // namespace

Process::Process(const std::vector<std::string>& command, const Environment& changes,
                 const std::filesystem::path& folder) {
    write(texts_ / "out", "");
    write(texts_ / "err", "");
    id_ = ::fork();
    if (id_ < 0) throw std::runtime_error("cannot start " + command.front());
    if (id_ == 0) become(command, changes, folder, texts_);
}

Process::~Process() {
    if (outcome_) return;
    signal(SIGKILL);
    reap(true);
}

bool Process::reap(bool block) {
    int status = 0;
    struct rusage usage {};
    if (::wait4(id_, &status, block ? 0 : WNOHANG, &usage) != id_) return false;
    Outcome outcome;
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.peak_megabytes = usage.ru_maxrss / 1024;
    for (const timeval& part : {usage.ru_utime, usage.ru_stime})
        outcome.cpu_seconds += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
    outcome.out = out();
    outcome.err = err();
    outcome_ = std::move(outcome);
    return true;
}

bool Process::running() {
    return !outcome_ && !reap(false);
}

void Process::signal(int number) const {
    if (!outcome_) ::kill(id_, number);
}

double Process::cpu_seconds() const {
    std::ifstream in("/proc/" + std::to_string(id_) + "/stat");
    std::string text(std::istreambuf_iterator<char>(in), {});
    // The second field is the name in parentheses, which may contain anything.
    const auto end_of_name = text.rfind(')');
    if (end_of_name == text.npos) return 0.0;
    std::istringstream fields(text.substr(end_of_name + 1));
    std::string skipped;
    for (int i = 3; i < 14; ++i) fields >> skipped;
    double user = 0.0, system = 0.0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

Outcome Process::wait(double seconds) {
    const double end = now() + seconds * sanitizer_factor;
    while (running()) {
        if (now() > end) {
            ADD_FAILURE() << "process " << id_ << " did not end within " << seconds << " s";
            signal(SIGKILL);
            reap(true);
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return *outcome_;
}

std::vector<std::string> program_command(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{TENDRIL_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
}

Outcome run_program(const std::vector<std::string>& arguments, const Environment& changes,
                    const std::filesystem::path& folder) {
    const TempFolder config;
    Environment environment{{"XDG_CONFIG_HOME", config.path().string()}};
    environment.insert(environment.end(), changes.begin(), changes.end());
    return Process(program_command(arguments), environment, folder).wait();
}

Outcome run_here(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    const std::filesystem::path started_in = std::filesystem::current_path();
    const TempFolder config;
    const char* const configured = std::getenv("XDG_CONFIG_HOME");
    const std::optional<std::string> before =
        configured ? std::optional<std::string>(configured) : std::nullopt;
    ::setenv("XDG_CONFIG_HOME", config.path().c_str(), 1);
    std::vector<std::string> words{"tendril"};
    words.insert(words.end(), arguments.begin(), arguments.end());

    Outcome outcome;
    const std::clock_t began = std::clock();
    if (!folder.empty()) std::filesystem::current_path(folder);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    outcome.exit_code = app::run_command_line(words);
    outcome.err = testing::internal::GetCapturedStderr();
    outcome.out = testing::internal::GetCapturedStdout();
    outcome.cpu_seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
    std::filesystem::current_path(started_in);
    before ? ::setenv("XDG_CONFIG_HOME", before->c_str(), 1) : ::unsetenv("XDG_CONFIG_HOME");
    return outcome;
}

int count_lines(const std::string& text) {
    const auto ends = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    return ends + (!text.empty() && text.back() != '\n' ? 1 : 0);
}

namespace {

/// Its stderr without its progress, which appears only on slow machines.
std::string messages(const Outcome& outcome) {
    std::istringstream lines(outcome.err);
    std::string kept;
    for (std::string line; std::getline(lines, line);)
        if (!line.ends_with(" %")) kept += line + "\n";
    return kept;
}

}  // namespace

testing::AssertionResult succeeded(const Outcome& outcome) {
    if (outcome.exit_code == 0 && messages(outcome).empty()) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "exit code " << outcome.exit_code << ", stderr: " << outcome.err;
}

testing::AssertionResult complained(const Outcome& outcome, int exit_code,
                                    const std::vector<std::string>& parts) {
    const auto failure = [&](const std::string& what) {
        return testing::AssertionFailure() << what << "; exit code " << outcome.exit_code << ", stderr: \""
                                           << outcome.err.substr(0, 2000) << '"';
    };
    if (outcome.exit_code != exit_code) return failure("expected exit code " + std::to_string(exit_code));
    if (count_lines(messages(outcome)) != 1) return failure("expected a single line on stderr");
    if (outcome.err.size() > 400) return failure("expected a line that one can read");
    for (const std::string& part : parts) {
        if (outcome.err.find(part) == outcome.err.npos) return failure("expected \"" + part + "\" on stderr");
    }
    return testing::AssertionSuccess();
}

}  // namespace tendril::test
