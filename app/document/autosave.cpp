#include "app/document/autosave.hpp"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "app/document/atomic_file.hpp"
#include "app/document/json_complete.hpp"
#include "app/document/scene_file.hpp"

namespace tendril::app {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view name_start = "autosave-", name_end = ".json";

bool is_running(int pid) {
    // A program of another user cannot be asked, but is there.
    return ::kill(pid, 0) == 0 || errno == EPERM;
}

std::string name_for(int pid, const std::string& more = "") {
    return std::string(name_start) + std::to_string(pid) + more + std::string(name_end);
}

/// Whether the file is an autosave whose program is gone. One that was put aside ("autosave-12.1.json")
/// always is.
bool is_left_behind(const std::string& name) {
    if (!name.starts_with(name_start) || !name.ends_with(name_end)) return false;
    if (name.size() < name_start.size() + name_end.size()) return false;
    const char* begin = name.data() + name_start.size();
    const char* end = name.data() + name.size() - name_end.size();
    int pid = 0;
    const auto [rest, error] = std::from_chars(begin, end, pid);
    if (error != std::errc() || pid <= 0) return false;
    return rest == end ? !is_running(pid) : *rest == '.';
}

}  // namespace

Autosave::Autosave(fs::path folder, Clock::duration interval)
    : folder_(std::move(folder)), interval_(interval) {
    // A file with our own number is from a program that had it before us and crashed: we must not overwrite
    // it.
    std::error_code ignored;
    for (int i = 1; fs::exists(file(), ignored) && i < 1000; ++i) {
        const fs::path aside = folder_ / name_for(::getpid(), std::string(".").append(std::to_string(i)));
        if (!fs::exists(aside, ignored)) fs::rename(file(), aside, ignored);
    }
}

void Autosave::end(Workspace& workspace, bool keep_unsaved) {
    if (keep_unsaved && workspace.modified()) {
        write(workspace);
    } else {
        remove();
    }
}

fs::path Autosave::file() const {
    return folder_ / name_for(::getpid());
}

void Autosave::remove() {
    std::error_code ignored;
    fs::remove(file(), ignored);
}

void Autosave::update(Workspace& workspace, Clock::time_point now) {
    if (!workspace.modified()) {
        // The file would offer what has been saved since.
        if (std::exchange(has_file_, false)) remove();
        waiting_ = false;
        return;
    }
    if (has_file_ && workspace.document == written_) {
        waiting_ = false;
        return;
    }
    if (!waiting_) changed_at_ = now;
    waiting_ = true;
    if (now - changed_at_ < interval_) return;
    waiting_ = false;
    write(workspace);
}

void Autosave::write(Workspace& workspace) {
    try {
        fs::create_directories(folder_);
        Json scene = save_scene(workspace);
        std::error_code ignored;
        if (!workspace.path.empty()) scene["path"] = fs::absolute(workspace.path, ignored).string();
        write_file_atomically(file(), json_to_text(scene));
        written_ = workspace.document;
        has_file_ = true;
        failed_ = false;
    } catch (const std::exception& error) {
        if (!std::exchange(failed_, true))
            workspace.toast(std::string("Autosave: ") + error.what(), ToastKind::Refusal);
    }
}

std::vector<fs::path> Autosave::left_behind(const fs::path& folder) {
    std::vector<std::pair<fs::file_time_type, fs::path>> found;
    std::error_code error;
    for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error)) {
        if (!is_left_behind(each->path().filename().string())) continue;
        std::error_code ignored;
        if (each->is_regular_file(ignored)) found.emplace_back(each->last_write_time(ignored), each->path());
    }
    std::sort(found.begin(), found.end(), std::greater<>());
    std::vector<fs::path> files;
    for (auto& [time, path] : found) files.push_back(std::move(path));
    return files;
}

std::string Autosave::title(const fs::path& file) {
    std::string name = "A scene without a name";
    try {
        const Json scene = read_json_file(file);
        if (scene.is_object() && scene.contains("path"))
            name = fs::path(json_text(scene["path"], "path")).filename().string();
    } catch (const std::exception&) {
        // What is wrong with it is said when it is opened.
    }
    struct stat written {};
    char when[64] = "";
    if (std::tm parts{}; ::stat(file.c_str(), &written) == 0 && ::localtime_r(&written.st_mtime, &parts))
        std::strftime(when, sizeof when, ", %Y-%m-%d %H:%M", &parts);
    return name + when;
}

void Autosave::recover(Workspace& workspace, const fs::path& file) {
    const Json scene = read_json_file(file);
    std::string path;
    if (scene.is_object() && scene.contains("path")) path = json_text(scene["path"], "path");
    load_scene(workspace, scene);
    workspace.path = path;
    workspace.saved = Document();
}

void Autosave::adopt(const fs::path& file) {
    std::error_code ignored;
    fs::rename(file, file.parent_path() / name_for(::getpid()), ignored);
}

}  // namespace tendril::app
