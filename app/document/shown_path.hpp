// How messages give the path of a file.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace tendril::app {

inline constexpr std::size_t longest_shown_path = 100;

/// The whole path, so that the file can be found: "~/pictures/tendril-1.png". Folders in the middle of a long
/// one become "..."; the name is always whole.
inline std::string shown_path(const std::filesystem::path& path) {
    std::error_code ignored;
    std::string text = std::filesystem::absolute(path, ignored).lexically_normal().string();
    const char* const home = std::getenv("HOME");
    const std::string under = home != nullptr ? std::string(home) + '/' : std::string();
    if (under.size() > 2 && text.starts_with(under)) text = "~/" + text.substr(under.size());
    if (text.size() <= longest_shown_path) return text;
    const std::size_t first = text.find('/', 1);
    if (first == text.npos) return text;
    const std::string begin = text.substr(0, first) + "/...";
    std::size_t end = text.rfind('/');
    while (end > first) {
        const std::size_t up = text.rfind('/', end - 1);
        if (up <= first || begin.size() + text.size() - up > longest_shown_path) break;
        end = up;
    }
    return end > first ? begin + text.substr(end) : text;
}

/// "Written: ~/pictures/tendril-1.png"
inline std::string written_text(const std::filesystem::path& path) {
    return "Written: " + shown_path(path);
}

}  // namespace tendril::app
