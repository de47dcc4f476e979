#include "app/shell/shell.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "app/shell/shortcuts.hpp"
#include "app/shell/theme.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/icons.hpp"

namespace tendril::app {
namespace {

constexpr ImGuiWindowFlags region_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                          ImGuiWindowFlags_NoNav;

/// "Play or pause (Space)": a title and its key, for a tooltip.
std::string with_keys(const char* title, std::string_view command) {
    const std::string keys = keys_for(command);
    return keys.empty() ? title : std::string(title) + " (" + keys + ")";
}

/// The strip along a panel's inner edge that makes it wider or narrower.
void panel_edge(const Rect& rect, bool left, float scale, Emit& emit) {
    const float x = left ? rect.max.x : rect.min.x;
    const float grip = 5.0f * scale;
    ImGui::SetCursorScreenPos({left ? x - grip : x, rect.min.y});
    ImGui::InvisibleButton("edge", {grip, std::max(1.0f, rect.size().y)});
    const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (lit) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImGui::GetWindowDrawList()->AddLine({left ? x - 1.0f : x, rect.min.y}, {left ? x - 1.0f : x, rect.max.y},
                                        ImGui::GetColorU32(lit ? ImGuiCol_SeparatorActive : ImGuiCol_Border));
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 1.0f)) {
        const float mouse = ImGui::GetIO().MousePos.x;
        const float width = (left ? mouse - rect.min.x : rect.max.x - mouse) / scale;
        emit.continuously("view.panel_width",
                          {{"side", left ? "left" : "right"}, {"width", number(std::clamp(width, 180.0f, 520.0f))}});
    }
}

}  // namespace

void begin_region(const char* name, const Rect& rect, glm::vec3 colour, ImVec2 padding) {
    ImGui::SetNextWindowPos({rect.min.x, rect.min.y});
    ImGui::SetNextWindowSize({std::max(1.0f, rect.size().x), std::max(1.0f, rect.size().y)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, imgui_colour(colour));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::Begin(name, nullptr, region_flags);
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

void Shell::menu(const ShellFrame& frame, Emit& emit) {
    if (icon_button("menu", Icon::Menu, "Menu")) ImGui::OpenPopup("menu popup");
    ImGui::SetNextWindowPos({ImGui::GetItemRectMin().x, frame.layout.top.max.y + 2.0f});
    if (!ImGui::BeginPopup("menu popup")) return;
    Section open = Section::Scene;
    bool first = true;
    for (const Shortcut& shortcut : shortcuts()) {
        if (!shortcut.in_menu) continue;
        if (first || shortcut.section != open) {
            if (!first) ImGui::Separator();
            ImGui::TextDisabled("%s", section_title(shortcut.section));
        }
        first = false;
        open = shortcut.section;
        const History& history = frame.workspace.history;
        const bool enabled = shortcut.command == "undo"   ? history.can_undo()
                             : shortcut.command == "redo" ? history.can_redo()
                                                          : true;
        if (ImGui::MenuItem(shortcut.title.c_str(), chord_label(shortcut.chord).c_str(), false, enabled)) {
            emit(shortcut.command, shortcut.arguments);
        }
    }
    ImGui::EndPopup();
}

void Shell::top_bar(const ShellFrame& frame, Emit& emit) {
    const Workspace& workspace = frame.workspace;
    const Layout& layout = frame.layout;
    const Palette& colours = palette(workspace.settings.theme);
    begin_region("top", layout.top, colours.bar, {10.0f * layout.scale, 8.0f * layout.scale});
    const float button = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemSpacing.x;

    menu(frame, emit);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(heading_font());
    ImGui::TextUnformatted("Tendril");
    ImGui::PopFont();
    for (const auto& lab : frame.labs.all()) {
        ImGui::SameLine(0.0f, 2.0f * gap);
        const bool open = lab->name() == workspace.lab;
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(open ? ImGuiCol_Header : ImGuiCol_ChildBg));
        if (ImGui::Button(lab->title().c_str())) emit("lab.open", {{"name", lab->name()}});
        ImGui::PopStyleColor();
    }

    const float middle = 0.5f * layout.top.size().x;
    char time[32];
    std::snprintf(time, sizeof time, "%8.2f s", static_cast<double>(workspace.clock.tick) * tick_seconds);
    const float time_width = ImGui::CalcTextSize("00000.00 s").x;
    ImGui::SameLine(middle - button - 0.5f * gap - 0.5f * time_width);
    const bool playing = workspace.clock.playing;
    if (icon_button("play", playing ? Icon::Pause : Icon::Play,
                    with_keys(playing ? "Pause" : "Play", "time.toggle").c_str())) {
        emit("time.toggle");
    }
    ImGui::SameLine();
    if (icon_button("step", Icon::Step, with_keys("One tick of 1/60 s", "time.step").c_str())) emit("time.step");
    ImGui::SameLine();
    const bool runs = playing && frame.lab.moving(workspace);
    ImGui::AlignTextToFramePadding();
    runs ? ImGui::TextUnformatted(time) : ImGui::TextDisabled("%s", time);

    const float right = layout.top.size().x - 10.0f * layout.scale;
    ImGui::SameLine(right - 4.0f * button - 3.0f * gap);
    const History& history = workspace.history;
    const auto about = [](const char* title, const std::string& what) {
        return what.empty() ? std::string(title) : std::string(title) + " " + what;
    };
    if (icon_button("undo", Icon::Undo, with_keys(about("Undo", history.undo_label()).c_str(), "undo").c_str(),
                    history.can_undo())) {
        emit("undo");
    }
    ImGui::SameLine();
    if (icon_button("redo", Icon::Redo, with_keys(about("Redo", history.redo_label()).c_str(), "redo").c_str(),
                    history.can_redo())) {
        emit("redo");
    }
    ImGui::SameLine();
    if (icon_button("help", Icon::Help, with_keys("Keys and mouse", "view.help").c_str(), true, workspace.ui.help)) {
        emit("view.help");
    }
    ImGui::SameLine();
    if (icon_button("settings", Icon::Gear, with_keys("Settings", "view.settings").c_str(), true, workspace.ui.settings)) {
        emit("view.settings");
    }
    ImGui::End();
}

void Shell::side_panel(const ShellFrame& frame, bool left, Emit& emit) {
    const Rect& rect = left ? frame.layout.left : frame.layout.right;
    if (rect.size().x < 1.0f) return;
    const float scale = frame.layout.scale;
    const Palette& colours = palette(frame.workspace.settings.theme);
    begin_region(left ? "left" : "right", rect, colours.panel, {0.0f, 0.0f});
    panel_edge(rect, left, scale, emit);
    ImGui::SetCursorPos({left ? 0.0f : 5.0f * scale, 0.0f});
    // The bar's room is always kept, so that nothing shifts when it is needed; unneeded, it is not seen.
    float& overflow = overflow_[left ? 0 : 1];
    const float grab = overflow > 0.0f ? 1.0f : 0.0f;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(14.0f * scale, 6.0f * scale));
    ImVec4 bar = ImGui::GetStyleColorVec4(ImGuiCol_ScrollbarGrab);
    bar.w *= grab;
    ImGui::PushStyleColor(ImGuiCol_ScrollbarGrab, bar);
    ImGui::BeginChild("content", {std::max(1.0f, rect.size().x - 5.0f * scale), 0.0f}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoNav |
                          ImGuiWindowFlags_AlwaysVerticalScrollbar);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    overflow = ImGui::GetScrollMaxY();
    if (left) {
        frame.lab.panel(frame.workspace, emit);
    } else {
        frame.lab.inspector(frame.workspace, emit);
    }
    ImGui::EndChild();
    ImGui::End();
}

void Shell::status_bar(const ShellFrame& frame) {
    const Workspace& workspace = frame.workspace;
    const Palette& colours = palette(workspace.settings.theme);
    const float scale = frame.layout.scale;
    begin_region("status", frame.layout.status, colours.bar, {14.0f * scale, 5.0f * scale});
    ImGui::PushFont(small_font());
    const std::string name = workspace.path.empty() ? "untitled" : workspace.path.filename().string();
    const std::string scene = name + (workspace.modified() ? " *" : "");
    const float room = ImGui::GetContentRegionAvail().x;
    const float scene_width = ImGui::CalcTextSize(scene.c_str()).x;
    ImGui::TextDisabled("%s", frame.hint.c_str());
    ImGui::SameLine(room - scene_width + ImGui::GetWindowContentRegionMin().x);
    ImGui::TextDisabled("%s", scene.c_str());
    ImGui::PopFont();
    ImGui::End();
}

void Shell::frame(const ShellFrame& frame, Emit& emit) {
    top_bar(frame, emit);
    side_panel(frame, true, emit);
    side_panel(frame, false, emit);
    const Workspace& workspace = frame.workspace;
    if (frame.layout.timeline.size().y > 1.0f) {
        const float scale = frame.layout.scale;
        begin_region("timeline", frame.layout.timeline, palette(workspace.settings.theme).panel,
                     {12.0f * scale, 6.0f * scale});
        frame.lab.timeline(workspace, emit);
        ImGui::End();
    }
    status_bar(frame);
    show_first_hint(frame);
    if (workspace.ui.help) show_help(frame, emit);
    if (workspace.ui.settings) show_settings(frame, emit);
    palette_.frame(workspace.ui.palette, frame.commands, {frame.layout.top.max.x, frame.layout.status.max.y},
                   frame.layout.scale, emit);
    file_dialog_.frame(workspace, {frame.layout.top.max.x, frame.layout.status.max.y}, emit);
    show_recovery(frame, emit);
    show_toasts(frame);
}

}  // namespace tendril::app
