#include "app/system/environment.hpp"

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <initializer_list>
#include <stdexcept>
#include <utility>

#ifdef _WIN32
#include <windows.h>
// then
#include <fcntl.h>
#include <io.h>
#include <shellapi.h>

#include <cstdio>
#include <cstring>
#include <cwchar>
#else
#include <unistd.h>

#include "app/system/child_process.hpp"
#endif

#ifdef __MINGW32__
/// libstdc++ converts narrow paths with mbrtowc, and msvcrt's does not know UTF-8; the linker calls this one
/// instead. Beyond the basic plane, the first byte gives one surrogate and the other three the second.
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
    const auto first = static_cast<unsigned char>(*from);
    const int length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (size < static_cast<std::size_t>(length)) return incomplete;
    wchar_t units[2];
    const int count = ::MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, from, length, units, 2);
    if (count == 0 || (count == 2 && state == nullptr)) return invalid;
    *to = units[0];
    if (count == 2) *state = units[1];
    return count == 2 ? 1 : units[0] == 0 ? 0 : static_cast<std::size_t>(length);
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

/// When its console or the user's session closes, Windows ends a program as soon as the signal's handler
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

void copy_png(std::string_view png) {
    const UINT format = ::RegisterClipboardFormatA("PNG");  // its name in browsers and office programs
    const HGLOBAL memory = ::GlobalAlloc(GMEM_MOVEABLE, png.size());
    if (memory == nullptr || ::OpenClipboard(nullptr) == 0) {
        ::GlobalFree(memory);
        throw std::runtime_error("cannot copy the picture: another program holds the clipboard");
    }
    std::memcpy(::GlobalLock(memory), png.data(), png.size());
    ::GlobalUnlock(memory);
    ::EmptyClipboard();
    const bool taken = ::SetClipboardData(format, memory) != nullptr;  // the clipboard then owns the memory
    ::CloseClipboard();
    if (taken) return;
    ::GlobalFree(memory);
    throw std::runtime_error("cannot copy the picture: the clipboard does not take it");
}

#else
namespace {

constexpr std::pair<const char*, const char*> user_settings{"HOME", ".config/tendril"};
constexpr int end_signals[]{SIGINT, SIGTERM, SIGHUP};

constexpr double max_copy_end = 10.0;  ///< seconds; both programs fork and end at once

std::vector<std::string> clipboard_command() {
    const std::string wayland = find_program("wl-copy").string(), x11 = find_program("xclip").string();
    const bool in_wayland = !environment_variable("WAYLAND_DISPLAY").empty();
    if (!wayland.empty() && (in_wayland || x11.empty())) return {wayland, "--type", "image/png"};
    if (!x11.empty()) return {x11, "-selection", "clipboard", "-t", "image/png"};
    throw std::runtime_error(std::string("to copy a picture, install ") +
                             (in_wayland ? "wl-clipboard" : "xclip"));
}

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

void copy_png(std::string_view png) {
    ChildProcess program(clipboard_command());
    program.write(png);
    program.finish(max_copy_end);
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
