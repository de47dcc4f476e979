// Overlays on the scene: help, settings, toasts, the first hint, the progress of a video, and questions.
#include <imgui.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "app/labs/labs.hpp"
#include "app/shell/gizmo_view.hpp"
#include "app/shell/labels_view.hpp"
#include "app/shell/shell.hpp"
#include "app/shell/ui.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

void key_row(const std::string& keys, const std::string& effect) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark));
    ImGui::TextWrapped("%s", keys.c_str());
    ImGui::PopStyleColor();
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", effect.c_str());
}

/// One table of the help: a title, then rows that `rows` adds.
template <class Rows>
void key_table(const char* title, float key_width, Rows rows) {
    const PanelSection ids(title);
    if (!ImGui::BeginTable(title, 2, ImGuiTableFlags_NoPadOuterX)) return;
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, key_width);
    ImGui::TableSetupColumn("effect", ImGuiTableColumnFlags_WidthStretch);
    rows();
    ImGui::EndTable();
}

/// The keys of a section that work in the open lab; alternative keys share a row.
void keys_of(const ShellFrame& frame, std::string_view section) {
    std::vector<std::string_view> shown;
    for (const Shortcut& shortcut : frame.shortcuts.all()) {
        if (shortcut.section != section || !frame.works_here(shortcut)) continue;
        if (std::find(shown.begin(), shown.end(), shortcut.title) != shown.end()) continue;
        key_row(frame.shortcuts.all_keys_for(shortcut), shortcut.title);
        shown.push_back(shortcut.title);
    }
}

/// The sections that the open lab adds to the shell's, in the order of the table.
std::vector<std::string_view> sections_of_lab(const ShellFrame& frame) {
    std::vector<std::string_view> sections;
    for (const Shortcut& shortcut : frame.shortcuts.all()) {
        const std::string_view section = shortcut.section;
        const bool known = std::ranges::find(sections, section) != sections.end() ||
                           std::ranges::any_of(frame.shortcuts.all(), [&](const Shortcut& s) {
                               return s.lab.empty() && s.section == section;
                           });
        if (!known && frame.works_here(shortcut)) sections.push_back(section);
    }
    return sections;
}

}  // namespace

bool begin_sheet(const char* title, glm::vec2 screen, glm::vec2 wanted) {
    const glm::vec2 size = glm::min(wanted, 0.94f * screen);
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({size.x, size.y});
    bool open = true;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 9.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    const float scale = ImGui::GetFontSize() / 15.0f;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(20.0f * scale, 14.0f * scale));
    ImGui::Begin(title, &open,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar(3);
    return open;
}

void show_help(const ShellFrame& frame, Emit& emit) {
    const float scale = frame.layout.scale;
    if (!begin_sheet("Keys and mouse", frame.screen(), {1180.0f * scale, 690.0f * scale})) {
        emit("view.help", {{"open", false}});
    }
    // Three columns if there is room for all of them; else two, or one.
    const float room = ImGui::GetContentRegionAvail().x;
    const int columns = room > 1040.0f * scale ? 3 : room > 720.0f * scale ? 2 : 1;
    const float mouse = std::min(190.0f * scale, 0.45f * room), keys = columns > 1 ? 150.0f * scale : mouse;
    if (ImGui::BeginTable("columns", columns, ImGuiTableFlags_NoPadOuterX)) {
        ImGui::TableNextColumn();
        key_table("Mouse", mouse, [&] {
            for (const auto& help :
                 frame.shortcuts.mouse_help(frame.workspace.lab, mouse_preset(frame.workspace.settings),
                                            scroll_action(frame.workspace.settings)))
                key_row(help.gesture, help.effect);
        });
        if (columns == 3) ImGui::TableNextColumn();
        const float beside = columns == 3 ? keys : mouse;
        key_table("Time", beside, [&] {
            keys_of(frame, "Time");
            for (const std::string_view section : sections_of_lab(frame)) keys_of(frame, section);
        });
        key_table("Help", beside, [&] { keys_of(frame, "Help"); });
        ImGui::TableNextColumn();
        for (const char* section : {"Scene", "Edit", "View"})
            key_table(section, keys, [&] { keys_of(frame, section); });
        ImGui::EndTable();
    }
    ImGui::End();
}

static void setting_row(const LabSetting& setting, const Settings& settings, Emit& emit) {
    std::vector<const char*> titles;
    for (const LabSetting::Choice& choice : setting.choices) titles.push_back(choice.title.c_str());
    std::string name = setting.key;
    std::replace(name.begin(), name.end(), '_', ' ');
    int chosen = static_cast<int>(setting.chosen(settings));
    if (choice_field(name.c_str(), chosen, titles.data(), static_cast<int>(titles.size())))
        emit(setting.command, {{setting.argument, setting.choices[static_cast<std::size_t>(chosen)].name}});
    explain(setting.help.c_str());
}

/// A list that closes on a choice: a button or slider would move under the mouse as the text grows.
static void text_size_row(const Settings& settings, Emit& emit) {
    static constexpr std::array percents{50, 75, 90, 100, 110, 125, 150, 175, 200, 250, 300};
    const int now = static_cast<int>(std::lround(100.0f * settings.text_scale));
    std::vector<std::string> texts;
    int chosen = static_cast<int>(std::ranges::find(percents, now) - percents.begin());
    for (const int percent : percents) texts.push_back(std::to_string(percent) + " %");
    if (chosen == static_cast<int>(percents.size())) texts.push_back(std::to_string(now) + " %");
    std::vector<const char*> titles;
    for (const std::string& text : texts) titles.push_back(text.c_str());
    if (choice_field("text size", chosen, titles.data(), static_cast<int>(titles.size())))
        emit("view.text_scale",
             {{"scale", chosen < static_cast<int>(percents.size())
                            ? 0.01f * static_cast<float>(percents[static_cast<std::size_t>(chosen)])
                            : settings.text_scale}});
    explain("The size of text and controls.");
}

void show_settings(const ShellFrame& frame, Emit& emit) {
    const Settings& settings = frame.workspace.settings;
    const float scale = frame.layout.scale;
    if (!begin_sheet("Settings", frame.screen(), {520.0f * scale, 680.0f * scale})) {
        emit("view.settings", {{"open", false}});
    }
    text_size_row(settings, emit);
    static constexpr const char* themes[] = {"dark", "light"};
    static constexpr const char* labels[] = {"on hover", "always"};
    int theme = settings.theme == Theme::Light, label = settings.labels == LabelMode::Always;
    if (choice_field("theme", theme, themes, 2)) emit("view.theme", {{"name", themes[theme]}});
    explain("The colours of the program: light text on a dark background, or dark on light.");
    if (choice_field("labels", label, labels, 2))
        emit("view.labels", {{"show", label == 1 ? "always" : "hover"}});
    explain("When labels are shown in the picture: only under the mouse, or always.");
    for (const LabSetting& setting : {mouse_setting(), scroll_setting()})
        setting_row(setting, settings, emit);
    for (const auto& lab : frame.labs.all()) {
        const std::vector<LabSetting> of_lab = lab->all_settings();
        if (of_lab.empty()) continue;
        const PanelSection ids(lab->title().c_str());
        for (const LabSetting& setting : of_lab) setting_row(setting, settings, emit);
    }
    ImGui::End();
}

void show_toasts(const ShellFrame& frame) {
    const float scale = frame.layout.scale;
    const Palette& colours = frame.colours();
    const Rect& view = frame.layout.view;
    const Rect legend = legend_box(frame.lab.legend(frame.workspace), view, scale);
    // As wide as the view; wider, over the panels, if the view is too narrow for legible text.
    const float margin = 32.0f * scale, legible = std::min(380.0f * scale, frame.screen().x - margin);
    const float widest =
        std::max(120.0f, std::min(520.0f * scale, std::max(view.size().x - margin, legible)));
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    const float wrap = widest - padding.x - 20.0f * scale;
    float bottom = view.max.y - 16.0f * scale;
    const auto& toasts = frame.workspace.ui.toasts;
    for (std::size_t i = toasts.size(); i-- > 0;) {
        const Toast& toast = toasts[i];
        const std::string id = "toast " + std::to_string(i);
        const ImVec2 text = ImGui::CalcTextSize(toast.text.c_str(), nullptr, false, wrap);
        const glm::vec2 size{text.x + 2.0f * padding.x, std::min(text.y + 2.0f * padding.y, 400.0f * scale)};
        const float half = 0.5f * size.x, edge = 8.0f * scale;
        const float centre = std::clamp(view.centre().x, std::min(half + edge, 0.5f * frame.screen().x),
                                        std::max(frame.screen().x - half - edge, 0.5f * frame.screen().x));
        const bool on_legend = centre - half < legend.max.x && centre + half > legend.min.x;
        if (on_legend && bottom > legend.min.y && legend.size().y > 0.0f)
            bottom = legend.min.y - 8.0f * scale;
        ImGui::SetNextWindowPos({centre, bottom}, ImGuiCond_Always, {0.5f, 1.0f});
        ImGui::SetNextWindowSize({size.x, size.y});
        ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 7.0f);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
        const glm::vec3 mark = toast.kind == ToastKind::Refusal ? colours.limit : colours.accent;
        ImGui::PushStyleColor(ImGuiCol_Border, imgui_colour(mark, 0.8f));
        ImGui::Begin(id.c_str(), nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                         ImGuiWindowFlags_NoNav);
        ImGui::PopStyleColor();
        ImGui::PopStyleVar(2);
        ImGui::PushTextWrapPos(padding.x + wrap);
        ImGui::TextUnformatted(toast.text.c_str());
        ImGui::PopTextWrapPos();
        bottom -= size.y + 8.0f * scale;
        ImGui::End();
    }
}

Rect show_first_hint(const ShellFrame& frame) {
    const Rect& view = frame.layout.view;
    const Rect none{view.min, view.min};
    if (frame.workspace.settings.hint_seen) return none;
    if (!frame.lab.panes(frame.workspace).empty()) return none;  // the panes have titles
    const Palette& colours = frame.colours();
    // Centred, or as far as the axis gizmo allows.
    constexpr float margin = 20.0f;
    const float end = view.max.x - std::max(margin, axis_gizmo_width(view.size(), frame.layout.scale));
    const float wrap = std::max(80.0f, end - view.min.x - margin);
    const auto size_of = [&](const std::string& text) {
        return ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    };
    const std::string first = frame.lab.invitation(frame.workspace);
    const std::string rest = view_hint(frame.workspace.settings, frame.by_finger, true);
    std::string text = first + " " + rest;
    if (ImGui::CalcTextSize(text.c_str()).x > wrap) text = first + "\n" + rest;
    if (size_of(text).y > 0.15f * view.size().y) text = first;  // large text in a small view
    if (size_of(text).y > 0.15f * view.size().y) return none;   // the picture takes precedence
    const float width = size_of(text).x;
    const ImVec2 at{std::min(view.centre().x - 0.5f * width, end - width),
                    view.min.y + 22.0f * frame.layout.scale};
    ImGui::GetBackgroundDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), at,
                                            imgui_u32(colours.text, 0.85f), text.c_str(), nullptr, wrap);
    return {{at.x, at.y}, {at.x + width, at.y + size_of(text).y}};
}

// The progress of the video being written, and a button to cancel it.

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
    explain("You can keep working while the video is written. It shows the scene as it was at the start.");
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

// Questions: about unsaved work, before quitting and after a crash; and how to open a file.

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
    if (row_button("Cancel", 3, true, "Esc: returns to the scene")) emit("view.close");
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
