#include "app/system/environment.hpp"

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <initializer_list>
#include <utility>

#ifdef _WIN32
#include <cwchar>

#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <shellapi.h>

#include <cstdio>
#else
#include <unistd.h>
#endif

#ifdef __MINGW32__
/// libstdc++ converts narrow paths with mbrtowc, and msvcrt's does not know UTF-8; the linker calls this one
/// instead. Outside the first plane, the first byte gives one half of a pair and the other three the second.
extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t size,
                                      std::mbstate_t* state) {
    constexpr std::size_t invalid = static_cast<std::size_t>(-1), incomplete = static_cast<std::size_t>(-2);
    if (from == nullptr) return 0;
    if (size == 0) return incomplete;
    wchar_t ignored = 0;
    if (to == nullptr) to = &ignored;
    if (state != nullptr && *state != 0) {
        *to = static_cast<wchar_t>(std::exchange(*state, 0));
        return 3;
    }
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(from[i]); };
    const std::size_t length = byte(0) < 0x80   ? 1
                               : byte(0) < 0xc2 ? 0
                               : byte(0) < 0xe0 ? 2
                               : byte(0) < 0xf0 ? 3
                               : byte(0) < 0xf5 ? 4
                                                : 0;
    if (length == 0) return invalid;
    if (size < length) return incomplete;
    unsigned code = length == 1 ? byte(0) : byte(0) & (0xffu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return invalid;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    if (length == 4 && state != nullptr) {
        *to = static_cast<wchar_t>(0xd800 + ((code - 0x10000) >> 10));
        *state = static_cast<std::mbstate_t>(0xdc00 + (code & 0x3ff));
        return 1;
    }
    *to = static_cast<wchar_t>(code);
    return code == 0 ? 0 : length;
}
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

/// Once its console or its user's session is closed, Windows ends a program as soon as the signal's handler
/// returns.
void wait_when_closed() {
    const auto wait = [](DWORD kind) -> BOOL {
        constexpr DWORD to_save = 4000;  // ms; Windows waits for five seconds
        if (kind == CTRL_CLOSE_EVENT || kind == CTRL_LOGOFF_EVENT || kind == CTRL_SHUTDOWN_EVENT) {
            std::raise(SIGTERM);
            ::Sleep(to_save);
        }
        return FALSE;
    };
    ::SetConsoleCtrlHandler(wait, TRUE);
}

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

void wait_when_closed() {}

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
    wait_when_closed();
}

fs::path config_folder() {
    for (const auto& [variable, below] : {std::pair{"XDG_CONFIG_HOME", "tendril"}, user_settings})
        // A relative path would depend on the working directory.
        if (const fs::path folder = environment_variable(variable); folder.is_absolute())
            return folder / below;
    return {};
}

std::string local_time(std::int64_t seconds, const char* format) {
    std::tm parts{};
    char text[64] = "";
    if (local_parts(static_cast<std::time_t>(seconds), parts))
        std::strftime(text, sizeof text, format, &parts);
    return text;
}

}  // namespace tendril::app
