#include "app/system/environment.hpp"

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <initializer_list>
#include <utility>

#ifdef _WIN32
#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <shellapi.h>

#include <cstdio>
#else
#include <unistd.h>
#endif

namespace tendril::app {
namespace fs = std::filesystem;

#ifdef _WIN32
namespace {

std::string utf8(const wchar_t* text) {
    const int size = ::WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
    std::string bytes(static_cast<std::size_t>(size), '\0');
    ::WideCharToMultiByte(CP_UTF8, 0, text, -1, bytes.data(), size, nullptr, nullptr);
    bytes.resize(bytes.find('\0'));
    return bytes;
}

constexpr std::pair<const char*, const char*> user_settings{"APPDATA", "tendril"};
constexpr int end_signals[]{SIGINT, SIGTERM, SIGBREAK};

bool local_parts(std::time_t time, std::tm& parts) {
    return ::localtime_s(&parts, &time) == 0;
}

}  // namespace

int process_id() {
    return static_cast<int>(::GetCurrentProcessId());
}

std::vector<std::string> begin_program(int, const char* const*) {
    for (std::FILE* const each : {stdin, stdout, stderr}) ::_setmode(::_fileno(each), _O_BINARY);
    ::SetConsoleOutputCP(CP_UTF8);
    DWORD others[2];
    if (::GetConsoleProcessList(others, 2) == 1) ::FreeConsole();
    int count = 0;
    wchar_t** const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
    std::vector<std::string> found;
    for (int i = 0; i < count; ++i) found.push_back(utf8(words[i]));
    ::LocalFree(words);
    return found;
}

std::string environment_variable(const char* name) {
    const std::string narrow = name;
    const wchar_t* const value = ::_wgetenv(std::wstring(narrow.begin(), narrow.end()).c_str());
    return value != nullptr ? utf8(value) : std::string();
}

bool errors_on_terminal() {
    const HANDLE console = ::GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    return ::GetConsoleMode(console, &mode) != 0 &&
           ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

std::string home_folder() {
    return {};
}

#else
namespace {

constexpr std::pair<const char*, const char*> user_settings{"HOME", ".config/tendril"};
constexpr int end_signals[]{SIGINT, SIGTERM, SIGHUP};

bool local_parts(std::time_t time, std::tm& parts) {
    return ::localtime_r(&time, &parts) != nullptr;
}

}  // namespace

int process_id() {
    return ::getpid();
}

std::vector<std::string> begin_program(int count, const char* const* words) {
    return {words, words + count};
}

std::string environment_variable(const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
}

bool errors_on_terminal() {
    return ::isatty(STDERR_FILENO) == 1;
}

std::string home_folder() {
    return environment_variable("HOME");
}
#endif

void handle_end_signals(void (*handler)(int)) {
    for (const int each : end_signals) std::signal(each, handler);
}

fs::path config_folder() {
    for (const auto& [variable, below] : {std::pair{"XDG_CONFIG_HOME", "tendril"}, user_settings})
        // A relative path would depend on the working directory.
        if (const fs::path folder = environment_variable(variable); folder.is_absolute()) return folder / below;
    return {};
}

std::string local_time(std::int64_t seconds, const char* format) {
    std::tm parts{};
    char text[64] = "";
    if (local_parts(static_cast<std::time_t>(seconds), parts)) std::strftime(text, sizeof text, format, &parts);
    return text;
}

}  // namespace tendril::app
