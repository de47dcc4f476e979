#include "app/document/autosave.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <ctime>
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

/// The stem of the newest Autosave; adopt() renames files to it.
std::string own_stem = std::to_string(::getpid());

std::string name_for(const std::string& stem) {
    return std::string(name_start).append(stem).append(name_end);
}

fs::path lock_of(const fs::path& folder, const std::string& stem) {
    return folder / std::string(name_start).append(stem).append(".lock");
}

/// Whether the file is an autosave whose program has ended. Always true of one that the constructor renamed
/// ("autosave-12.1.json").
bool is_left_behind(const fs::path& file) {
    const std::string name = file.filename().string();
    if (!name.starts_with(name_start) || !name.ends_with(name_end)) return false;
    if (name.size() < name_start.size() + name_end.size()) return false;
    const std::string stem =
        name.substr(name_start.size(), name.size() - name_start.size() - name_end.size());
    int pid = 0;
    const auto [rest, error] = std::from_chars(stem.data(), stem.data() + stem.size(), pid);
    if (error != std::errc() || pid <= 0) return false;
    const std::string_view more(rest, static_cast<std::size_t>(stem.data() + stem.size() - rest));
    if (more.starts_with('.')) return true;
    return (more.empty() || more.starts_with('_')) && !FileLock::is_held(lock_of(file.parent_path(), stem));
}

/// Removes temporary files of programs that were killed while writing. Files being written now are younger
/// than the minute that this leaves.
void remove_torn_files(const fs::path& folder) {
    std::error_code error;
    const auto old = fs::file_time_type::clock::now() - std::chrono::minutes(1);
    for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error)) {
        const std::string name = each->path().filename().string();
        std::error_code ignored;
        if (name.starts_with(".tendril-") && name.ends_with(".tmp") && each->is_regular_file(ignored) &&
            each->last_write_time(ignored) < old)
            fs::remove(each->path(), ignored);
    }
}

}  // namespace

Autosave::Autosave(fs::path folder, Clock::duration interval)
    : folder_(std::move(folder)), interval_(interval) {
    std::error_code ignored;
    fs::create_directories(folder_, ignored);
    remove_torn_files(folder_);
    const std::string pid = std::to_string(::getpid());
    for (int i = 1; !lock_ && i < 100; ++i) {
        stem_ = i == 1 ? pid : pid + "_" + std::to_string(i);
        lock_ = FileLock::take(lock_of(folder_, stem_));
    }
    own_stem = stem_;
    // An existing file of that name is a crashed program's, which had the same process ID: keep it.
    for (int i = 1; fs::exists(file(), ignored) && i < 1000; ++i) {
        const fs::path aside = folder_ / name_for(stem_ + "." + std::to_string(i));
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
    return folder_ / name_for(stem_);
}

void Autosave::remove() {
    std::error_code ignored;
    fs::remove(file(), ignored);
}

void Autosave::update(Workspace& workspace, Clock::time_point now) {
    if (!workspace.modified()) {
        // Otherwise the file would offer changes that have been saved since.
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
        if (!is_left_behind(each->path())) continue;
        std::error_code ignored;
        if (each->is_regular_file(ignored)) found.emplace_back(each->last_write_time(ignored), each->path());
    }
    std::sort(found.begin(), found.end(), std::greater<>());
    std::vector<fs::path> files;
    for (auto& [time, path] : found) files.push_back(std::move(path));
    return files;
}

std::string Autosave::title(const fs::path& file) {
    std::string name = "Unnamed scene";
    try {
        const Json scene = read_json_file(file);
        if (scene.is_object() && scene.contains("path"))
            name = fs::path(json_text(scene["path"], "path")).filename().string();
    } catch (const std::exception&) {
        // Errors are reported when the file is opened.
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
    fs::rename(file, file.parent_path() / name_for(own_stem), ignored);
}

}  // namespace tendril::app
