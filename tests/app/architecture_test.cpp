// The rooms of DESIGN: each includes only what stands above it, the library knows nothing of the program, and
// files stay short enough to read.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

const Strings app_rooms{"document", "window", "view", "io", "widgets", "labs", "shell", "script", "batch"};
const Strings core_rooms{"math", "chain", "ik", "rope", "signal", "rig", "humanoid"};
const Strings window_parts{"GL/", "glad/", "GLFW/", "EGL/", "imgui", "backends/"};

struct Source {
    std::string path;  ///< from the top of the project
    Strings includes;  ///< as written, without brackets or quotes
    int lines = 0;
};

Source read_source(const fs::path& file, const fs::path& top) {
    Source source{file.lexically_relative(top).generic_string(), {}, 0};
    std::ifstream in(file);
    for (std::string line; std::getline(in, line); ++source.lines) {
        const auto hash = line.find_first_not_of(' ');
        if (hash == line.npos || line[hash] != '#' || line.find("include", hash) == line.npos) continue;
        const auto open = line.find_first_of("<\"", hash);
        const auto close = open == line.npos ? line.npos : line.find_first_of(">\"", open + 1);
        if (close != line.npos) source.includes.push_back(line.substr(open + 1, close - open - 1));
    }
    return source;
}

std::vector<Source> sources_in(const std::string& folder) {
    const fs::path top = TENDRIL_SOURCE_DIR;
    std::vector<Source> sources;
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
        const auto extension = entry.path().extension();
        if (entry.is_regular_file() && (extension == ".cpp" || extension == ".hpp"))
            sources.push_back(read_source(entry.path(), top));
    }
    std::sort(sources.begin(), sources.end(),
              [](const Source& a, const Source& b) { return a.path < b.path; });
    return sources;
}

/// The folder's name that follows `before` in `path`; empty where no folder does.
std::string folder_after(const std::string& path, const std::string& before) {
    if (!path.starts_with(before)) return {};
    const auto end = path.find('/', before.size());
    return end == path.npos ? std::string() : path.substr(before.size(), end - before.size());
}

std::string app_room(const std::string& path) {
    return folder_after(path, "app/");
}

/// Of "core/src/ik/x.cpp", "core/include/tendril/ik/x.hpp" and "tendril/ik/x.hpp".
std::string core_room(const std::string& path) {
    for (const char* before : {"core/src/", "core/include/tendril/", "tendril/"})
        if (const std::string room = folder_after(path, before); !room.empty()) return room;
    return {};
}

/// How high a room stands; what is in no room stands below them all.
std::ptrdiff_t rank(const Strings& rooms, const std::string& room) {
    return std::find(rooms.begin(), rooms.end(), room) - rooms.begin();
}

bool starts_with_any(const std::string& text, const Strings& starts) {
    return std::any_of(starts.begin(), starts.end(),
                       [&](const std::string& start) { return text.starts_with(start); });
}

TEST(Architecture, the_sources_are_there) {
    EXPECT_GE(sources_in("app/document").size(), 15u);
    EXPECT_GE(sources_in("app/script").size(), 5u);
    EXPECT_FALSE(sources_in("core").empty());
}

TEST(Architecture, every_room_is_in_the_list) {
    for (const Source& source : sources_in("app")) {
        const std::string room = app_room(source.path);
        EXPECT_TRUE(room.empty() || rank(app_rooms, room) < std::ssize(app_rooms)) << source.path;
    }
    for (const Source& source : sources_in("core")) {
        const std::string room = core_room(source.path);
        EXPECT_TRUE(room.empty() || rank(core_rooms, room) < std::ssize(core_rooms)) << source.path;
    }
}

TEST(Architecture, a_room_of_the_program_includes_only_what_stands_above_it) {
    for (const Source& source : sources_in("app")) {
        for (const std::string& include : source.includes) {
            if (!include.starts_with("app/")) continue;
            EXPECT_LE(rank(app_rooms, app_room(include)), rank(app_rooms, app_room(source.path)))
                << source.path << " includes " << include;
        }
    }
}

TEST(Architecture, the_program_names_its_files_from_the_top) {
    for (const Source& source : sources_in("app"))
        for (const std::string& include : source.includes)
            EXPECT_FALSE(include.starts_with(".")) << source.path << " includes " << include;
}

TEST(Architecture, a_room_of_the_library_includes_only_what_stands_above_it) {
    for (const Source& source : sources_in("core")) {
        for (const std::string& include : source.includes) {
            const std::string room = core_room(include);
            if (room.empty()) continue;
            EXPECT_LE(rank(core_rooms, room), rank(core_rooms, core_room(source.path)))
                << source.path << " includes " << include;
        }
    }
}

TEST(Architecture, the_library_knows_nothing_of_windows_files_or_the_program) {
    Strings foreign = window_parts;
    foreign.insert(foreign.end(), {"app/", "nlohmann/", "CLI/", "stb_", "filesystem", "fstream", "iostream"});
    for (const Source& source : sources_in("core"))
        for (const std::string& include : source.includes)
            EXPECT_FALSE(starts_with_any(include, foreign)) << source.path << " includes " << include;
}

TEST(Architecture, what_is_saved_drawn_or_scripted_is_described_without_gl) {
    for (const Source& source : sources_in("app")) {
        const bool plain = starts_with_any(
            source.path, {"app/document/", "app/script/", "app/io/", "app/batch/", "app/view/draw_list.",
                          "app/view/camera.", "app/view/picking.", "app/view/mesh.", "app/view/surface",
                          "app/view/tube", "app/view/cloth", "app/view/spline", "app/view/edges."});
        if (!plain) continue;
        for (const std::string& include : source.includes)
            EXPECT_FALSE(starts_with_any(include, window_parts)) << source.path << " includes " << include;
    }
}

TEST(Architecture, only_the_window_and_the_renderer_call_gl) {
    for (const Source& source : sources_in("app")) {
        if (starts_with_any(source.path, {"app/window/", "app/view/"})) continue;
        for (const std::string& include : source.includes)
            EXPECT_FALSE(starts_with_any(include, {"GL/", "glad/", "EGL/"}))
                << source.path << " includes " << include;
    }
}

TEST(Architecture, no_file_is_longer_than_400_lines) {
    for (const char* folder : {"app", "core", "tests"})
        for (const Source& source : sources_in(folder)) EXPECT_LE(source.lines, 400) << source.path;
}

}  // namespace
