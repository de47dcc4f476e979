// Questions: about unsaved work, before quitting and after a crash; and how to open a file.
#include <imgui.h>

#include "app/shell/shell.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {

void show_recovery(const ShellFrame& frame, Emit& emit) {
    const auto& offers = frame.workspace.ui.recoverable;
    if (offers.empty()) return;
    const float scale = frame.layout.scale;
    if (!begin_sheet("Unsaved work", frame.screen(), {460.0f * scale, 165.0f * scale}))
        emit("scene.recover_later");
    note("Tendril ended before this work was saved:");
    text_elided(offers.front().title, ImGui::GetContentRegionAvail().x);
    explain(offers.front().file.string().c_str());
    ImGui::Spacing();
    const ArgumentList path{{"path", offers.front().file.string()}};
    if (row_button("Recover it", 2, true, "Opens the unsaved scene")) emit("scene.recover", path);
    if (row_button("Delete it", 2, true, "Deletes this work for good; the open scene stays"))
        emit("scene.discard", path);
    ImGui::End();
}

void show_quit(const ShellFrame& frame, Emit& emit) {
    if (!frame.workspace.ui.asks_to_quit) return;
    const float scale = frame.layout.scale;
    if (!begin_sheet("Quit Tendril", frame.screen(), {460.0f * scale, 120.0f * scale})) emit("view.close");
    const std::filesystem::path& path = frame.workspace.path;
    const std::string rest = " has unsaved changes.";
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(rest.c_str()).x;
    ImGui::TextUnformatted(
        (elided(path.empty() ? "The scene" : path.filename().string(), room) + rest).c_str());
    ImGui::Spacing();
    const bool named = !path.empty();
    if (row_button(named ? "Save" : "Save...", 3, true, "Saves the scene, then quits"))
        emit("quit", {{"unsaved", "save"}});
    if (row_button("Discard", 3, true, "Quits; the changes are lost")) emit("quit", {{"unsaved", "discard"}});
    if (row_button("Cancel", 3, true, "Esc: goes on working")) emit("view.close");
    ImGui::End();
}

void show_file_question(const ShellFrame& frame, Emit& emit) {
    const auto& [path, ways] = frame.workspace.ui.file_question;
    if (ways.empty()) return;
    const float scale = frame.layout.scale;
    const std::string file = std::filesystem::path(path).filename().string();
    if (!begin_sheet("Open a file", frame.screen(),
                     {460.0f * scale, (112.0f + 36.0f * static_cast<float>(ways.size())) * scale}))
        emit("view.close");
    text_elided(file, ImGui::GetContentRegionAvail().x);
    explain(path.c_str());
    ImGui::Spacing();
    for (const FileWay& way : ways)
        if (row_button(way.title.c_str(), 1, true, way.help.c_str()))
            emit("file.open", {{"path", path}, {"by", way.command}});
    if (row_button("Cancel", 1, true, "Esc: opens nothing")) emit("view.close");
    ImGui::End();
}

}  // namespace tendril::app
