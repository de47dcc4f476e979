// The process and its surroundings. Texts are UTF-8 on every system.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::app {

/// Whether this system starts threads; a web page does not.
#ifdef __EMSCRIPTEN__
inline constexpr bool has_threads = false;
#else
inline constexpr bool has_threads = true;
#endif

int process_id();

/// The words of the command line, with the program's name first, from main()'s arguments. Call once, at the
/// start: on Windows it also makes the console and pipes pass bytes unchanged, and detaches from a console
/// that was opened for this program alone.
std::vector<std::string> begin_program(int count, const char* const* words);

/// Calls `handler` when the program is asked to end: by Ctrl+C, by another program, or because its terminal
/// or login session was closed. It may only set flags. SIG_DFL ends the program at once.
void handle_end_signals(void (*handler)(int));

/// Empty if not set.
std::string environment_variable(const char* name);

/// True if stderr is a terminal that takes escape sequences.
bool errors_on_terminal();

/// The folder that "~" stands for; empty where "~" means nothing.
std::string home_folder();
/// Folder for this user's settings and autosaves: below XDG_CONFIG_HOME if that is set, else in ~/.config or,
/// on Windows, in AppData\Roaming. Empty if it is unknown.
std::filesystem::path config_folder();

/// Puts a PNG file's bytes on the clipboard; text goes through the window's own. On Linux, wl-copy or xclip
/// does it. Throws std::runtime_error, naming the program to install, if that is not possible.
void copy_png(std::string_view png);

/// Unix time in strftime's `format`, in this machine's time zone; empty if the time cannot be converted.
std::string local_time(std::int64_t seconds, const char* format);

}  // namespace tendril::app
