#include "app/shell/file_dialog.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <glm/common.hpp>
#include <utility>

#include "app/labs/labs.hpp"
#include "app/shell/shell.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

namespace fs = std::filesystem;

bool FileDialog::is_listed(const fs::path& file) const {
    const fs::path ending = file.extension();
    if (filming()) return video_kind(file) != nullptr;
    if (picturing()) return ending == ".png";
    if (saving()) return ending == ".json";
    if (filter_ > 0) return has_ending(kinds_[static_cast<std::size_t>(filter_ - 1)], file);
    return std::any_of(kinds_.begin(), kinds_.end(),
                       [&](const FileKind& kind) { return has_ending(kind, file); });
}

void FileDialog::open_folder(const fs::path& folder) {
    std::error_code error;
    fs::directory_iterator each(folder, error);
    if (error) {
        error_ = folder.string() + ": " + error.message();
        return;
    }
    folder_ = folder;
    error_.clear();
    entries_.clear();
    for (; each != fs::directory_iterator(); each.increment(error)) {
        if (error) break;
        const std::string name = each->path().filename().string();
        const bool is_folder = each->is_directory(error);
        if (name.starts_with('.') || (!is_folder && !is_listed(each->path()))) continue;
        entries_.push_back({name, is_folder});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.folder != b.folder ? a.folder : a.name < b.name;
    });
}

/// The command closes the dialog if it succeeds: a refused name stays for editing.
void FileDialog::send(const fs::path& path, Emit& emit) {
    if (picturing()) return emit(picture_.command(), picture_.arguments(path));
    if (saving()) return emit("scene.save", {{"path", path.string()}});
    opened_ = path.parent_path();
    ArgumentList given{{"path", path.string()}, {"ask", true}};
    if (!by_.empty()) given.push_back({"by", by_});
    emit("file.open", given);
}

void FileDialog::take(Emit& emit) {
    if (name_[0] == '\0') return;
    fs::path path = fs::path(name_.data()).is_absolute() ? fs::path(name_.data()) : folder_ / name_.data();
    std::error_code error;
    if (fs::is_directory(path, error)) {
        open_folder(path);
        name_.fill('\0');
        return;
    }
    if (picturing())
        path = picture_.with_ending(path);
    else if (saving() && path.extension().empty())
        path += ".json";
    send(path, emit);
}

void FileDialog::start(const Workspace& workspace, const Labs& labs) {
    kinds_.clear();
    by_ = workspace.ui.browses_for;
    for (FileRoute& route : file_routes(labs))
        if (by_.empty() || (route.lab != nullptr && by_.starts_with(route.lab->name() + '.')))
            kinds_.push_back(std::move(route.kind));
    const auto own = [&](const FileKind& kind) { return kind.command == by_; };
    if (std::ranges::any_of(kinds_, own))
        std::erase_if(kinds_, std::not_fn(own));
    else if (!by_.empty())  // bone maps are recognised by their beginning, and opened by their own command
        std::erase_if(kinds_, [](const FileKind& kind) { return kind.begins != nullptr; });
    filter_ = 0;
    std::error_code error;
    const fs::path home =
        workspace.path.empty() ? fs::current_path(error) : fs::absolute(workspace.path).parent_path();
    if (std::exchange(home_, home) != home) opened_.clear();
    open_folder(!saving() && fs::is_directory(opened_, error) ? opened_ : home);
    const Lab& lab = *labs.find(workspace.lab);
    if (picturing())
        picture_.start(workspace, lab.labels_pictures(workspace), filming(), lab.loop_ticks(workspace));
    const std::string name = picturing() ? picture_name(workspace, folder_)
                             : saving()  ? workspace.path.filename().string()
                                         : std::string();
    std::snprintf(name_.data(), name_.size(), "%s", name.c_str());
}

void FileDialog::show_filter() {
    std::vector<std::string> texts{by_.empty() ? "every kind of file" : "all of these"};
    for (const FileKind& kind : kinds_) texts.push_back(kind_text(kind));
    std::vector<const char*> titles;
    for (const std::string& text : texts) titles.push_back(text.c_str());
    if (choice_field("show", filter_, titles.data(), static_cast<int>(titles.size()))) open_folder(folder_);
    explain("Which kinds of files are listed");
}

std::string FileDialog::empty_message() const {
    if (std::ranges::any_of(entries_, [](const Entry& each) { return !each.folder; })) return {};
    if (picturing()) return filming() ? "No videos here yet." : "No pictures here yet.";
    if (saving()) return "No scenes here yet.";
    std::string kinds;
    for (std::size_t i = 0; i < kinds_.size(); ++i)
        if (filter_ == 0 || filter_ == static_cast<int>(i) + 1)
            kinds += (kinds.empty() ? "" : ", ") + kind_text(kinds_[i]);
    return "No files that can be opened here: " + kinds + '.';
}

bool FileDialog::list() {
    fs::path entered;
    bool chosen = false;
    for (const Entry& entry : entries_) {
        const std::string shown = entry.folder ? entry.name + "/" : entry.name;
        if (!ImGui::Selectable(shown.c_str(), entry.name == name_.data(),
                               ImGuiSelectableFlags_AllowDoubleClick)) {
            explain(entry.folder ? "Shows what is in this folder" : "Double click takes it at once");
            continue;
        }
        if (entry.folder) {
            entered = folder_ / entry.name;
        } else {
            std::snprintf(name_.data(), name_.size(), "%s", entry.name.c_str());
            chosen = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
        }
    }
    if (const std::string why = empty_message(); !why.empty()) note(why);
    if (!entered.empty()) open_folder(entered);
    return chosen;
}

void FileDialog::frame(const Workspace& workspace, const Labs& labs, glm::vec2 screen, float scale,
                       Emit& emit) {
    const auto wanted = workspace.ui.file_dialog;
    const bool open = wanted != UiState::FileDialog::None;
    const bool appearing = open && (shown_ != wanted || by_ != workspace.ui.browses_for);
    shown_ = wanted;
    if (!open) return;
    if (appearing) start(workspace, labs);
    const glm::vec2 size =
        glm::max(glm::vec2(520.0f, picturing() ? 280.0f + 31.0f * picture_.rows() : 420.0f) * scale,
                 glm::vec2(0.5f, 0.6f) * screen);
    if (!begin_sheet(title(), screen, size)) emit("view.close");
    if (ImGui::Button("Up")) open_folder(folder_.parent_path());
    explain("Shows the folder above this one");
    ImGui::SameLine();
    text_elided(folder_.string(), ImGui::GetContentRegionAvail().x, true);
    const float wrap = ImGui::GetContentRegionAvail().x;
    const float complaint =
        error_.empty() ? 0.0f : ImGui::CalcTextSize(error_.c_str(), nullptr, false, wrap).y;
    const float rows = picturing() ? 2.0f + picture_.rows() : saving() ? 2.0f : 3.0f;
    ImGui::BeginChild("entries", {0.0f, -rows * ImGui::GetFrameHeightWithSpacing() - complaint}, true);
    bool done = list();
    ImGui::EndChild();
    if (picturing()) picture_.frame();
    if (!saving()) show_filter();
    ImGui::SetNextItemWidth(-1.0f);
    const bool cut = !appearing && shows_cut_text("##name", name_.data());
    if (appearing) ImGui::SetKeyboardFocusHere();
    if (!cut && ImGui::InputTextWithHint("##name", "file name", name_.data(), name_.size(),
                                         ImGuiInputTextFlags_EnterReturnsTrue)) {
        done = true;
        ImGui::SetKeyboardFocusHere(-1);  // keep the focus, to edit a refused name
    }
    explain("The name of the file. Enter confirms it.");
    done |= ImGui::Button(action());
    explain(filming()     ? "Writes the video and shows its progress"
            : picturing() ? "Writes the picture to this file"
            : saving()    ? "Saves the scene to this file"
                          : "Opens this file in its lab");
    if (picturing() && !filming()) {
        ImGui::SameLine();
        if (ImGui::Button("Copy")) emit("view.copy_picture", picture_.arguments({}));
        explain("Puts the picture on the clipboard");
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) emit("view.close");
    explain("Esc: closes this and changes nothing");
    if (!error_.empty()) note(error_);
    if (done) take(emit);
    ImGui::End();
}

}  // namespace tendril::app
