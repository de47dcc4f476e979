#include "app/document/autosave.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>
#include <utility>

#include "app/document/scene_file.hpp"
#include "app/io/json_complete.hpp"
#include "app/system/atomic_file.hpp"
#include "app/system/environment.hpp"

namespace tendril::app {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view name_start = "autosave-", name_end = ".json";

/// The stem of the newest Autosave; recover() derives file names from it.
std::string own_stem = std::to_string(process_id());

std::string name_for(const std::string& stem) {
    return std::string(name_start).append(stem).append(name_end);
}

fs::path lock_of(const fs::path& folder, const std::string& stem) {
    return folder / std::string(name_start).append(stem).append(".lock");
}

/// True if the file is an autosave whose program has ended: "autosave-12.json", "autosave-12_2.json" (a
/// second program with that process ID) or "autosave-12.1.json" (recovered work).
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
    return (more.empty() || more.starts_with('_') || more.starts_with('.')) &&
           !FileLock::is_held(lock_of(file.parent_path(), stem.substr(0, stem.find('.'))));
}

/// Removes the locks of programs that were killed.
void remove_left_locks(const fs::path& folder) {
    std::vector<fs::path> locks;
    std::error_code error;
    for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error)) {
        const std::string name = each->path().filename().string();
        std::error_code ignored;
        if (name.starts_with(name_start) && name.ends_with(".lock") && each->is_regular_file(ignored))
            locks.push_back(each->path());
    }
    for (const fs::path& each : locks) FileLock::take(each);  // released at once, which removes it
}

/// Renames the file to a free name of this program and returns it; empty if that fails.
fs::path adopted(const fs::path& file) {
    std::error_code error;
    fs::path mine;
    for (int i = 1; i == 1 || fs::exists(mine, error); ++i)
        mine = file.parent_path() / name_for(own_stem + '.' + std::to_string(i));
    fs::rename(file, mine, error);
    return error ? fs::path() : mine;  // another program has taken it
}

}  // namespace

Autosave::Autosave(fs::path folder, Clock::duration interval)
    : folder_(std::move(folder)), interval_(interval) {
    std::error_code ignored;
    fs::create_directories(folder_, ignored);
    remove_torn_files(folder_);
    remove_left_locks(folder_);
    const std::string pid = std::to_string(process_id());
    for (int i = 1; !lock_ && i < 100; ++i) {
        stem_ = i == 1 ? pid : pid + "_" + std::to_string(i);
        // A crashed program may have had the same process ID: leave its files alone.
        const std::vector<fs::path> left = left_behind(folder_);
        const auto has_stem = [&](const fs::path& each) {
            const std::string name = each.filename().string(), stem = std::string(name_start) + stem_;
            return name.starts_with(stem + '.');
        };
        if (std::ranges::none_of(left, has_stem)) lock_ = FileLock::take(lock_of(folder_, stem_));
    }
    own_stem = stem_;
}

void Autosave::end(Workspace& workspace, bool keep_unsaved) {
    if (keep_unsaved && workspace.modified()) {
        write(workspace);
    } else {
        std::error_code ignored;
        fs::remove(file_of(workspace), ignored);
    }
}

fs::path Autosave::file() const {
    return folder_ / name_for(stem_);
}

void Autosave::update(Workspace& workspace, Clock::time_point now) {
    std::error_code ignored;
    if (shown_ != workspace.recovered) {
        shown_ = workspace.recovered;
        has_file_ = fs::exists(file_of(workspace), ignored);
        written_ = Document();
    }
    if (!workspace.modified()) {
        // Otherwise the file would offer changes that have been saved since.
        if (std::exchange(has_file_, false)) fs::remove(file_of(workspace), ignored);
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
        write_file_atomically(file_of(workspace), json_to_text(scene));
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
    const FileStamp written = file_stamp(file);
    return written == FileStamp() ? name : name + local_time(written.seconds, ", %Y-%m-%d %H:%M");
}

void Autosave::recover(Workspace& workspace, const fs::path& file) {
    const Json scene = read_json_file(file);
    std::string path;
    if (scene.is_object() && scene.contains("path")) path = json_text(scene["path"], "path");
    const std::vector<LabNote> notes =
        load_scene(workspace, scene, {.folder = fs::path(path).parent_path(), .whole = false});
    workspace.path = path;
    workspace.saved = Document();
    workspace.recovered = adopted(file);
    tell(workspace, notes);
}

}  // namespace tendril::app
