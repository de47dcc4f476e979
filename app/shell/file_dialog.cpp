#include "app/shell/file_dialog.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "app/shell/shell.hpp"

namespace tendril::app {

namespace fs = std::filesystem;

void FileDialog::go_to(const fs::path& folder) {
    std::error_code error;
    fs::directory_iterator each(folder, error);
    if (error) {
        complaint_ = folder.string() + ": " + error.message();
        return;
    }
    folder_ = folder;
    complaint_.clear();
    entries_.clear();
    for (; each != fs::directory_iterator(); each.increment(error)) {
        if (error) break;
        const std::string name = each->path().filename().string();
        const bool is_folder = each->is_directory(error);
        if (name.starts_with('.') || (!is_folder && each->path().extension() != ".json")) continue;
        entries_.push_back({name, is_folder});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.folder != b.folder ? a.folder : a.name < b.name;
    });
}

void FileDialog::take(bool saving, const fs::path& mine, Emit& emit) {
    if (name_[0] == '\0') return;
    fs::path path = fs::path(name_.data()).is_absolute() ? fs::path(name_.data()) : folder_ / name_.data();
    std::error_code error;
    if (fs::is_directory(path, error)) {
        go_to(path);
        name_.fill('\0');
        return;
    }
    if (saving && path.extension().empty()) path += ".json";
    if (saving && path != mine && path != confirmed_ && fs::exists(path, error)) {
        confirmed_ = path;
        complaint_ = path.filename().string() + " is there already. Save once more to replace it.";
        return;
    }
    emit("view.close");
    emit(saving ? "scene.save" : "scene.open", {{"path", path.string()}});
}

void FileDialog::frame(const Workspace& workspace, glm::vec2 screen, Emit& emit) {
    const auto wanted = workspace.ui.file_dialog;
    const bool open = wanted != UiState::FileDialog::None;
    const bool appearing = open && !was_open_;
    was_open_ = open;
    if (!open) return;
    const bool saving = wanted == UiState::FileDialog::SaveAs;
    if (appearing) {
        std::error_code error;
        const fs::path start = workspace.path.empty() ? fs::current_path(error) : fs::absolute(workspace.path).parent_path();
        go_to(start);
        confirmed_.clear();
        std::snprintf(name_.data(), name_.size(), "%s", saving ? workspace.path.filename().string().c_str() : "");
    }
    if (!begin_sheet(saving ? "Save scene as" : "Open scene", screen, {0.5f * screen.x, 0.6f * screen.y})) {
        emit("view.close");
    }
    if (ImGui::Button("Up")) go_to(folder_.parent_path());
    ImGui::SameLine();
    ImGui::TextDisabled("%s", folder_.string().c_str());
    ImGui::BeginChild("entries", {0.0f, -2.0f * ImGui::GetFrameHeightWithSpacing() - ImGui::GetTextLineHeight()}, true);
    fs::path entered;
    for (const Entry& entry : entries_) {
        const std::string shown = entry.folder ? entry.name + "/" : entry.name;
        if (!ImGui::Selectable(shown.c_str(), entry.name == name_.data(), ImGuiSelectableFlags_AllowDoubleClick)) continue;
        if (entry.folder) {
            entered = folder_ / entry.name;
        } else {
            std::snprintf(name_.data(), name_.size(), "%s", entry.name.c_str());
            if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) take(saving, workspace.path, emit);
        }
    }
    if (!entered.empty()) go_to(entered);
    ImGui::EndChild();
    ImGui::SetNextItemWidth(-1.0f);
    if (appearing) ImGui::SetKeyboardFocusHere();
    const bool done = ImGui::InputTextWithHint("##name", "file name", name_.data(), name_.size(),
                                               ImGuiInputTextFlags_EnterReturnsTrue);
    if (ImGui::Button(saving ? "Save" : "Open") || done) take(saving, workspace.path, emit);
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) emit("view.close");
    if (!complaint_.empty()) ImGui::TextDisabled("%s", complaint_.c_str());
    ImGui::End();
}

}  // namespace tendril::app
