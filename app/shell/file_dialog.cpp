#include "app/shell/file_dialog.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <glm/common.hpp>

#include "app/shell/shell.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

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
        complaint_ = path.filename().string() + " already exists. Press Save again to replace it.";
        return;
    }
    // The command closes the dialog where it succeeds: a refused name stays, to be mended.
    emit(saving ? "scene.save" : "scene.open", {{"path", path.string()}});
}

void FileDialog::start(const Workspace& workspace, bool saving) {
    std::error_code error;
    go_to(workspace.path.empty() ? fs::current_path(error) : fs::absolute(workspace.path).parent_path());
    confirmed_.clear();
    std::snprintf(name_.data(), name_.size(), "%s", saving ? workspace.path.filename().string().c_str() : "");
}

bool FileDialog::list() {
    fs::path entered;
    bool chosen = false;
    for (const Entry& entry : entries_) {
        const std::string shown = entry.folder ? entry.name + "/" : entry.name;
        if (!ImGui::Selectable(shown.c_str(), entry.name == name_.data(),
                               ImGuiSelectableFlags_AllowDoubleClick))
            continue;
        if (entry.folder) {
            entered = folder_ / entry.name;
        } else {
            std::snprintf(name_.data(), name_.size(), "%s", entry.name.c_str());
            chosen = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
        }
    }
    if (!entered.empty()) go_to(entered);
    return chosen;
}

void FileDialog::frame(const Workspace& workspace, glm::vec2 screen, float scale, Emit& emit) {
    const auto wanted = workspace.ui.file_dialog;
    const bool open = wanted != UiState::FileDialog::None;
    const bool appearing = open && shown_ != wanted;
    shown_ = wanted;
    if (!open) return;
    const bool saving = wanted != UiState::FileDialog::Open;
    if (appearing) start(workspace, saving);
    const glm::vec2 size = glm::max(glm::vec2(520.0f, 420.0f) * scale, glm::vec2(0.5f, 0.6f) * screen);
    if (!begin_sheet(saving ? "Save scene as" : "Open scene", screen, size)) emit("view.close");
    if (ImGui::Button("Up")) go_to(folder_.parent_path());
    ImGui::SameLine();
    text_elided(folder_.string(), ImGui::GetContentRegionAvail().x, true);
    const float wrap = ImGui::GetContentRegionAvail().x;
    const float complaint =
        complaint_.empty() ? 0.0f : ImGui::CalcTextSize(complaint_.c_str(), nullptr, false, wrap).y;
    ImGui::BeginChild("entries", {0.0f, -2.0f * ImGui::GetFrameHeightWithSpacing() - complaint}, true);
    bool done = list();
    ImGui::EndChild();
    ImGui::SetNextItemWidth(-1.0f);
    if (appearing) ImGui::SetKeyboardFocusHere();
    if (ImGui::InputTextWithHint("##name", "file name", name_.data(), name_.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue)) {
        done = true;
        ImGui::SetKeyboardFocusHere(-1);  // a name that is refused can be mended at once
    }
    done |= ImGui::Button(saving ? "Save" : "Open");
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) emit("view.close");
    if (!complaint_.empty()) note(complaint_);
    if (done) take(saving, workspace.path, emit);
    ImGui::End();
}

}  // namespace tendril::app
