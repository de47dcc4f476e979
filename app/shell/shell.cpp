#include "app/shell/shell.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "app/document/command.hpp"
#include "app/document/scene_file.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/shell/card_watch.hpp"
#include "app/shell/gizmo_view.hpp"
#include "app/shell/labels_view.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/number_entry.hpp"
#include "app/widgets/row_search.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

constexpr ImGuiWindowFlags region_flags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNavFocus;  // Tab still moves between fields

constexpr float folds_below = 90.0f;  ///< unscaled pixels: a panel dragged narrower than this folds

/// "Play or pause (Space)": a title and its key, for a tooltip.
std::string with_keys(const ShellFrame& frame, const char* title, std::string_view command) {
    const std::string keys = frame.shortcuts.keys_for(command);
    return keys.empty() ? title : std::string(title) + " (" + keys + ")";
}

/// The strip along a panel's inner edge; drag to resize or fold it.
void panel_edge(const Rect& rect, bool left, float scale, Emit& emit) {
    const float x = left ? rect.max.x : rect.min.x;
    const float grip = 5.0f * scale;
    ImGui::SetCursorScreenPos({left ? x - grip : x, rect.min.y});
    ImGui::InvisibleButton("edge", {grip, std::max(1.0f, rect.size().y)});
    const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (lit) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (lit && !ImGui::IsItemActive())
        tooltip("Drag to make the panel wider or narrower; dragged very narrow, it folds");
    ImGui::GetWindowDrawList()->AddLine({left ? x - 1.0f : x, rect.min.y}, {left ? x - 1.0f : x, rect.max.y},
                                        ImGui::GetColorU32(lit ? ImGuiCol_SeparatorActive : ImGuiCol_Border));
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 1.0f)) {
        const float mouse = ImGui::GetIO().MousePos.x;
        const float width = (left ? mouse - rect.min.x : rect.max.x - mouse) / scale;
        if (width < folds_below) {
            emit("view.panels", {{left ? "left" : "right", false}});
            return;
        }
        emit.continuously("view.panel_width",
                          {{"side", left ? "left" : "right"}, {"width", std::clamp(width, 180.0f, 520.0f)}});
    }
}

/// Begins a fixed window without decoration that fills `rect`; with `scrolls` it has a scroll bar if its
/// contents do not fit. Always call ImGui::End() after it.
void begin_region(const char* name, const Rect& rect, glm::vec3 colour, ImVec2 padding,
                  bool scrolls = false) {
    ImGui::SetNextWindowPos({rect.min.x, rect.min.y});
    ImGui::SetNextWindowSize({std::max(1.0f, rect.size().x), std::max(1.0f, rect.size().y)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, imgui_colour(colour));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::Begin(name, nullptr, scrolls ? region_flags & ~ImGuiWindowFlags_NoScrollbar : region_flags);
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

/// A folded panel's strip, which unfolds it. The strip above the panel below the scene also folds that.
void fold_strip(const ShellFrame& frame, const Rect& rect, bool left, Emit& emit) {
    const bool below = !left && frame.layout.upright, folds = below && frame.layout.right_open;
    const bool pressed = ImGui::InvisibleButton("unfold", {rect.size().x, std::max(1.0f, rect.size().y)});
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (hovered) {
        list->AddRectFilled({rect.min.x, rect.min.y}, {rect.max.x, rect.max.y},
                            ImGui::GetColorU32(ImGuiCol_ButtonHovered));
        tooltip(with_keys(frame, folds ? "Hide the panel" : "Show the panel", "view.panels"));
    }
    const glm::vec2 end = left ? glm::vec2(rect.max.x - 1.0f, rect.min.y) : rect.min;
    list->AddLine({end.x, end.y}, {below ? rect.max.x : end.x, below ? end.y : rect.max.y},
                  ImGui::GetColorU32(ImGuiCol_Border));
    const Icon icon = folds ? Icon::ChevronDown : left || below ? Icon::ChevronRight : Icon::ChevronLeft;
    draw_icon(list, icon, {rect.centre().x, rect.centre().y},
              std::min(0.8f * std::min(rect.size().x, rect.size().y), 14.0f * frame.layout.scale),
              ImGui::GetColorU32(hovered ? ImGuiCol_Text : ImGuiCol_TextDisabled));
    if (!pressed) return;
    ArgumentList panels{{left ? "left" : "right", !folds}};
    if (frame.layout.one_panel && !folds) panels.push_back({left ? "right" : "left", false});
    emit("view.panels", panels);
}

/// Positions a popup of the bar, which scrolls if the window is too low for it.
void place_below_bar(const ShellFrame& frame, float x) {
    const float y = frame.layout.top.max.y + 2.0f;
    ImGui::SetNextWindowPos({x, y});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f},
                                        {frame.screen().x, std::max(1.0f, frame.screen().y - y - 2.0f)});
}

void menu(const ShellFrame& frame, Emit& emit) {
    const bool pressed = icon_button("menu", Icon::Menu, "Menu");
    place_below_bar(frame, ImGui::GetItemRectMin().x);
    if (!begin_menu("menu popup", pressed)) return;
    close_popup_on_escape();
    // Tighter than a panel's rows, so that the whole menu fits a window 720 pixels high.
    const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(spacing.x, 0.65f * spacing.y));
    std::string_view open;
    for (const Shortcut& shortcut : frame.shortcuts.all()) {
        if (!shortcut.in_menu || !frame.works_here(shortcut)) continue;
        if (shortcut.section != open) {
            if (!open.empty()) ImGui::Separator();
            ImGui::TextDisabled("%s", shortcut.section.c_str());
        }
        open = shortcut.section;
        const History& history = frame.workspace.history;
        const bool undo = shortcut.command == "undo", redo = shortcut.command == "redo";
        const bool enabled = undo ? history.can_undo() : !redo || history.can_redo();
        const std::string title = undo   ? undo_title(frame.commands, history)
                                  : redo ? redo_title(frame.commands, history)
                                         : shortcut.title;
        if (ImGui::MenuItem(title.c_str(), chord_label(shortcut.chord).c_str(), false, enabled)) {
            emit(shortcut.command, shortcut.arguments);
        }
    }
    ImGui::PopStyleVar();
    ImGui::EndPopup();
}

float button_width(const std::string& title) {
    return ImGui::CalcTextSize(title.c_str()).x + 2.0f * ImGui::GetStyle().FramePadding.x;
}

/// The labs as a drop-down list with the name of the open one.
void tab_list(const ShellFrame& frame, Emit& emit) {
    ImGui::SameLine();
    const std::string title = frame.lab.title() + " ...";
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
    const bool pressed = ImGui::Button((title + "###labs").c_str());
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) tooltip("The other labs");
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    place_below_bar(frame, low.x);
    if (begin_menu("labs", pressed)) {
        close_popup_on_escape();
        for (const auto& lab : frame.labs.all())
            if (ImGui::MenuItem(lab->title().c_str(), nullptr, lab->name() == frame.workspace.lab))
                emit("lab.open", {{"name", lab->name()}});
        ImGui::EndPopup();
    }
    // The next item must follow the button, not the last row of its list.
    ImGui::SetCursorScreenPos(low);
    ImGui::Dummy({high.x - low.x, high.y - low.y});
}

/// The program's name, if there is room for it, and the labs.
void tabs(const ShellFrame& frame, float room, Emit& emit) {
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    ImGui::PushFont(heading_font());
    float needed = gap + ImGui::CalcTextSize("Tendril").x;
    const float name = needed;
    for (const auto& lab : frame.labs.all()) needed += 2.0f * gap + button_width(lab->title());
    if (needed - name > room) {
        ImGui::PopFont();
        return tab_list(frame, emit);
    }
    if (needed <= room) {
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted("Tendril");
    }
    ImGui::PopFont();
    for (const auto& lab : frame.labs.all()) {
        ImGui::SameLine(0.0f, 2.0f * gap);
        const bool open = lab->name() == frame.workspace.lab;
        ImGui::PushStyleColor(ImGuiCol_Button,
                              ImGui::GetStyleColorVec4(open ? ImGuiCol_Header : ImGuiCol_ChildBg));
        if (ImGui::Button(lab->title().c_str())) emit("lab.open", {{"name", lab->name()}});
        ImGui::PopStyleColor();
        if (ImGui::IsItemHovered())
            tooltip(open ? "The " + lab->title() + " lab is open"
                         : "Opens the " + lab->title() + " lab; this one does not change");
    }
}

void play_button(const ShellFrame& frame, Emit& emit) {
    const bool playing = frame.workspace.clock.playing, moving = frame.lab.moving(frame.workspace);
    if (!moving) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    if (icon_button("play", playing ? Icon::Pause : Icon::Play, nullptr)) emit("time.toggle");
    if (!moving) ImGui::PopStyleColor();
    if (!ImGui::IsItemHovered()) return;
    const char* effect = !moving ? "Nothing here moves with time" : playing ? "Pause" : "Play";
    tooltip(with_keys(frame, effect, "time.toggle"));
}

/// Centred in the window if possible, between `from` and `to`; without the time if space is short.
void time_controls(const ShellFrame& frame, float from, float to, Emit& emit) {
    const Clock& clock = frame.workspace.clock;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float buttons = 2.0f * ImGui::GetFrameHeight() + gap;
    const float time_width = ImGui::CalcTextSize("00000.00 s").x;
    const bool with_time = buttons + gap + time_width <= to - from;
    const float width = with_time ? buttons + gap + time_width : buttons;
    const float middle = 0.5f * (frame.layout.top.size().x - buttons - time_width);
    ImGui::SameLine(std::clamp(middle, from, std::max(from, to - width)));
    play_button(frame, emit);
    ImGui::SameLine();
    if (icon_button("step", Icon::Step, with_keys(frame, "One tick of 1/60 s", "time.step").c_str()))
        emit("time.step");
    if (!with_time) return;
    char time[32];
    std::snprintf(time, sizeof time, "%8.2f s", frame.lab.seconds(frame.workspace));
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const bool runs = clock.playing && frame.lab.moving(frame.workspace);
    runs ? ImGui::TextUnformatted(time) : ImGui::TextDisabled("%s", time);
}

/// Undo, redo, help and settings, from `from` to the right end.
void tools(const ShellFrame& frame, float from, Emit& emit) {
    const Workspace& workspace = frame.workspace;
    const History& history = workspace.history;
    const auto tool = [&](const char* command, Icon icon, const std::string& tip, bool enabled, bool active) {
        ImGui::SameLine(std::exchange(from, 0.0f));
        if (icon_button(command, icon, with_keys(frame, tip.c_str(), command).c_str(), enabled, active))
            emit(command, std::ranges::find(frame.shortcuts.all(), command, &Shortcut::command)->arguments);
    };
    tool("undo", Icon::Undo, undo_title(frame.commands, history), history.can_undo(), false);
    tool("redo", Icon::Redo, redo_title(frame.commands, history), history.can_redo(), false);
    tool("view.help", Icon::Help, "Keys and mouse", true, workspace.ui.help);
    tool("view.settings", Icon::Gear, "Settings", true, workspace.ui.settings);
}

void top_bar(const ShellFrame& frame, Emit& emit) {
    const Layout& layout = frame.layout;
    begin_region("top", layout.top, frame.colours().bar, {10.0f * layout.scale, 8.0f * layout.scale});
    const float button = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemSpacing.x;
    const float tools_at = layout.top.size().x - 10.0f * layout.scale - 4.0f * button - 3.0f * gap;
    menu(frame, emit);
    tabs(frame, tools_at - ImGui::GetItemRectMax().x - 2.0f * button - 5.0f * gap, emit);
    time_controls(frame, ImGui::GetItemRectMax().x + 2.0f * gap, tools_at - 2.0f * gap, emit);
    tools(frame, tools_at, emit);
    ImGui::End();
}

void status_bar(const ShellFrame& frame) {
    const Workspace& workspace = frame.workspace;
    const float scale = frame.layout.scale;
    begin_region("status", frame.layout.status, frame.colours().bar, {14.0f * scale, 5.0f * scale});
    ImGui::PushFont(small_font());
    const std::string name = workspace.path.empty() ? "untitled" : workspace.path.filename().string();
    const float room = ImGui::GetContentRegionAvail().x;
    const std::string scene = elided(name + (workspace.modified() ? " *" : ""), 0.4f * room);
    const float scene_width = ImGui::CalcTextSize(scene.c_str()).x;
    const float free = room - scene_width - 2.0f * ImGui::GetFontSize();
    std::string hint = frame.hint.empty() ? view_hint(workspace.settings, frame.by_finger) : frame.hint;
    if (frame.hint.empty() && ImGui::CalcTextSize(hint.c_str()).x > free)
        hint = view_hint(workspace.settings, frame.by_finger, true);
    text_elided(hint, free, true);
    ImGui::SameLine(room - scene_width + ImGui::GetWindowContentRegionMin().x);
    ImGui::TextDisabled("%s", scene.c_str());
    ImGui::PopFont();
    ImGui::End();
}

std::string with_change(const CommandTable& commands, const char* title, const std::string& label) {
    const Command* const command = commands.find(label);
    if (command == nullptr) return title;
    return std::string(title) + ": " + lower_case(command->title.substr(0, 1)) + command->title.substr(1);
}

/// Unfolds the section of that title, if there is one, and the sections that hide a row of the command.
void unfold(const ShellFrame& frame, const std::string& title, const std::string& command,
            const Json& arguments, Emit& emit) {
    RowSearch search{.title = title, .command = command};
    for (const auto& [name, value] : arguments.items()) search.arguments.push_back(name);
    {
        const SearchWindow window(search);
        Emit unused;
        frame.lab.panel(frame.workspace, unused);
        search.inside.clear();
        frame.lab.inspector(frame.workspace, unused);
    }
    std::vector<std::string> unfolded;
    for (const std::string& section : search.found) {
        if (std::ranges::find(unfolded, section) != unfolded.end()) continue;
        unfolded.push_back(section);
        emit("view.fold", {{"section", section}, {"folded", false}});
    }
}

}  // namespace

std::string undo_title(const CommandTable& commands, const History& history) {
    return with_change(commands, "Undo", history.undo_label());
}

std::string redo_title(const CommandTable& commands, const History& history) {
    return with_change(commands, "Redo", history.redo_label());
}

/// Content that became shorter cannot keep its scroll position. When it is long again, as after undo, the
/// position is restored, unless the user has scrolled since.
void Shell::keep_scroll(Scrolled& scrolled) {
    constexpr float same = 1.0f;  // pixels
    if (std::exchange(scrolled.to_top, false)) {
        scrolled.wanted = scrolled.shown = 0.0f;
        return ImGui::SetScrollY(0.0f);
    }
    const float now = ImGui::GetScrollY(), most = ImGui::GetScrollMaxY();
    const bool moved = std::abs(now - scrolled.shown) > same;
    if (moved && !(now < scrolled.shown && now > most - same && most < scrolled.most)) scrolled.wanted = now;
    scrolled.shown = now;
    scrolled.most = most;
    if (scrolled.wanted < now + same || most < now + same) return;
    scrolled.shown = std::min(scrolled.wanted, most);
    ImGui::SetScrollY(scrolled.shown);
}

void Shell::side_panel(const ShellFrame& frame, bool left, Emit& emit) {
    const Rect& rect = left ? frame.layout.left : frame.layout.right;
    if (rect.size().x < 1.0f) return;
    const bool open = left ? frame.layout.left_open : frame.layout.right_open;
    const bool below = !left && frame.layout.upright;
    if (!open && !below) {
        begin_region(left ? "left strip" : "right strip", rect, frame.colours().panel, {0.0f, 0.0f});
        fold_strip(frame, rect, left, emit);
        return ImGui::End();
    }
    const float scale = frame.layout.scale, edge = below ? 0.0f : 5.0f * scale;
    const float above = below ? 24.0f * scale : 0.0f;  // enough for a thumb
    begin_region(left ? "left" : "right", rect, frame.colours().panel, {0.0f, 0.0f});
    if (below)
        fold_strip(frame, {rect.min, {rect.max.x, rect.min.y + above}}, left, emit);
    else
        panel_edge(rect, left, scale, emit);
    ImGui::SetCursorPos({left ? 0.0f : edge, above});
    // The scroll bar's space is always reserved, so that nothing shifts when it appears; it is transparent
    // while unneeded.
    float& overflow = overflow_[left ? 0 : 1];
    const float grab = overflow > 0.0f ? 1.0f : 0.0f;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                        ImVec2(std::min(14.0f * scale, 0.06f * rect.size().x), 6.0f * scale));
    ImVec4 bar = ImGui::GetStyleColorVec4(ImGuiCol_ScrollbarGrab);
    bar.w *= grab;
    ImGui::PushStyleColor(ImGuiCol_ScrollbarGrab, bar);
    const float width = std::max(1.0f, rect.size().x - edge), height = rect.size().y - above;
    const float card = left || !open ? 0.0f : card_height(frame, {width, height});
    const float room = card > 0.0f ? std::max(1.0f, height - card) : 0.0f;
    ImGui::PushID(frame.workspace.lab.c_str());  // each lab's panel keeps its own scroll position
    ImGui::BeginChild("content", {width, room}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoNavFocus |
                          ImGuiWindowFlags_AlwaysVerticalScrollbar);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    overflow = ImGui::GetScrollMaxY();
    keep_scroll(scrolled_[{frame.workspace.lab, left}]);
    if (left) {
        frame.lab.panel(frame.workspace, emit);
    } else {
        const std::string& lab = frame.workspace.lab;
        if (const std::string why = stand_in_note(lab, *frame.workspace.document.parts().at(lab));
            !why.empty())
            coloured_note(why, frame.colours().limit);
        frame.lab.inspector(frame.workspace, emit);
    }
    light_card_section(frame, left);
    ImGui::EndChild();
    ImGui::PopID();
    if (card > 0.0f) {
        ImGui::SetCursorPos({edge, above + room});
        ImGui::BeginChild("card", {width, card}, false, ImGuiWindowFlags_NoScrollbar);
        show_card(frame, {width, height}, emit);
        ImGui::EndChild();
    }
    ImGui::End();
}

void Shell::frame(const ShellFrame& frame, Emit& emit) {
    const Layout& layout = frame.layout;
    NumberEditing& editing = number_editing();
    editing.middle_min = {layout.left.max.x, layout.top.max.y};
    editing.middle_max = {layout.timeline.max.x, layout.timeline.min.y};
    editing.covered = frame.workspace.ui.covered();
    top_bar(frame, emit);
    side_panel(frame, true, emit);
    side_panel(frame, false, emit);
    const Workspace& workspace = frame.workspace;
    if (frame.layout.canvas.size().x > 1.0f) {
        const float padding = 12.0f * frame.layout.scale;
        begin_region("canvas", frame.layout.canvas, frame.colours().bar, {padding, padding}, true);
        frame.lab.canvas(workspace, emit);
        ImGui::End();
    }
    if (frame.layout.timeline.size().y > 1.0f) {
        const float scale = frame.layout.scale;
        begin_region("timeline", frame.layout.timeline, frame.colours().panel, {12.0f * scale, 6.0f * scale});
        frame.lab.timeline(workspace, emit);
        ImGui::End();
    }
    status_bar(frame);
    overlays_ = {
        show_first_hint(frame),
        show_legend(frame.lab.legend(workspace), frame.layout.view, frame.colours(), frame.layout.scale),
        show_axis_gizmo(frame, emit)};
    card_ring_ = show_card_halo(frame, highlighted_);
    if (workspace.ui.help) show_help(frame, emit);
    if (workspace.ui.settings) show_settings(frame, emit);
    if (const auto ran = palette_.take_run()) unfolding_.for_command(frame, *ran, emit);  // in its lab
    palette_.frame(frame, emit);
    unfolding_.for_step(frame, step_to_do(frame), emit);
    file_dialog_.frame(workspace, frame.labs, frame.screen(), frame.layout.scale, emit);
    show_filming(frame, emit);
    show_recovery(frame, emit);
    show_quit(frame, emit);
    show_file_question(frame, emit);
    show_toasts(frame);
}

Layout lay_out(glm::vec2 window, float scale, const Settings& settings, float timeline, float canvas) {
    constexpr float bar = 44.0f, status = 28.0f, verdict = 116.0f;
    constexpr float min_view = 0.34f;  // fraction of the width that the middle always keeps

    // Only one panel fits in a narrow window, or with text so large that two panels would be too narrow for
    // their labels. It may then be as wide as both.
    constexpr float narrow = 900.0f, usual_width = 272.0f;
    const bool upright = window.x < std::min(narrow, window.y);
    const float folded = upright ? 24.0f : 12.0f;  // for a thumb, or for the mouse
    const float both = std::max(0.0f, (1.0f - min_view) * window.x);
    const bool one_panel = window.x < narrow || 2.0f * usual_width * scale > both;
    const float most = one_panel ? std::max(0.5f * both, both - folded * scale) : 0.5f * both;
    const auto side = [&](bool open, float width) {
        return std::round(std::min((open ? width : folded) * scale, most));
    };
    const bool right_open = settings.right_open && !(one_panel && settings.left_open);
    const float left = side(settings.left_open, settings.left_width);
    const float right = upright ? 0.0f : side(right_open, settings.right_width);
    const float top = std::round(bar * scale);
    const float low = std::max(top, window.y - std::round(status * scale));
    // The scene always keeps half of the height beside the panel, and beside the strip.
    const float below = upright ? std::min(right_open ? low : verdict * scale, 0.5f * (low - top)) : 0.0f;
    const float bottom = low - std::floor(below);
    const float strip = std::min(std::round(timeline * scale), std::max(0.0f, 0.5f * (bottom - top)));
    const float middle = bottom - std::floor(strip);

    Layout layout;
    layout.scale = scale;
    layout.left_open = settings.left_open, layout.right_open = right_open;
    layout.one_panel = one_panel, layout.upright = upright;
    layout.top = {{0.0f, 0.0f}, {window.x, top}};
    layout.status = {{0.0f, low}, {window.x, window.y}};
    layout.left = {{0.0f, top}, {left, low}};
    layout.right = {{upright ? left : window.x - right, upright ? bottom : top}, {window.x, low}};
    layout.timeline = {{left, middle}, {window.x - right, bottom}};
    const float split = std::round(left + canvas * (window.x - right - left));
    layout.canvas = {{left, top}, {split, middle}};
    layout.view = {{split, top}, {window.x - right, middle}};
    return layout;
}

void Unfolding::for_step(const ShellFrame& frame, const CardStep* step, Emit& emit) {
    if (std::exchange(step_, step) == step || step == nullptr || step->place == CardStep::Place::Handle)
        return;
    for (const CardLine& line : step->by)
        unfold(frame, step->place_name, line.command, *line.arguments, emit);
}

void Unfolding::for_command(const ShellFrame& frame, const Emitted& command, Emit& emit) {
    unfold(frame, "", command.name, *command.arguments, emit);
}

}  // namespace tendril::app
