// The progress of the video being written, and a button to cancel it.
#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/shell/shell.hpp"
#include "app/shell/theme.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {

void show_filming(const ShellFrame& frame, Emit& emit) {
    const auto& filming = frame.workspace.ui.filming;
    if (!filming) return;
    const float scale = frame.layout.scale;
    const Rect& view = frame.layout.view;
    const float width = std::min(340.0f * scale, frame.screen().x);
    ImGui::SetNextWindowPos({view.centre().x, view.min.y + 16.0f * scale}, ImGuiCond_Always, {0.5f, 0.0f});
    ImGui::SetNextWindowSize({width, 0.0f});
    ImGui::Begin("video", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    text_elided("Writing " + filming->name, ImGui::GetContentRegionAvail().x);
    explain(
        "You can go on working while the video is written. It shows the scene as it was when you started "
        "it.");
    const float part = static_cast<float>(filming->done) / static_cast<float>(std::max(1, filming->frames));
    const bool all = filming->done == filming->frames;
    const std::string count =
        all ? "finishing the file"
            : "frame " + std::to_string(filming->done) + " of " + std::to_string(filming->frames);
    const float button = ImGui::CalcTextSize("Cancel").x + 2.0f * ImGui::GetStyle().FramePadding.x;
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, imgui_colour(frame.colours().accent, 0.5f));
    ImGui::ProgressBar(part, {-button - ImGui::GetStyle().ItemSpacing.x, 0.0f}, count.c_str());
    ImGui::PopStyleColor();
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) emit("view.end_video");
    explain("Esc: cancels the video; no file is left");
    ImGui::End();
}

}  // namespace tendril::app
