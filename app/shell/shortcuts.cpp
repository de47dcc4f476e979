#include "app/shell/shortcuts.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "app/document/command.hpp"
#include "app/io/text.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {
namespace {

constexpr const char* last_section = "Help";

/// The rows common to all labs.
std::vector<Shortcut> common_rows() {
    constexpr bool hidden = false, typing = true, shown = true, again = true;
    constexpr const char* own = "";  // the command's title
    const auto row = [](const char* chord, const char* command, ArgumentList arguments, const char* title,
                        const char* section, bool in_menu = true, bool while_typing = false,
                        bool repeats = false) {
        return Shortcut{*chord_from_name(chord),
                        command,
                        std::move(arguments),
                        title,
                        section,
                        in_menu,
                        while_typing,
                        repeats};
    };
    return {
        row("ctrl+n", "scene.new", {}, own, "Scene"),
        row("ctrl+o", "scene.open_dialog", {}, own, "Scene"),
        row("ctrl+s", "scene.save_dialog", {{"ask", false}}, "Save", "Scene"),
        row("ctrl+shift+s", "scene.save_dialog", {{"ask", true}}, "Save as...", "Scene"),
        row("ctrl+p", "view.picture_dialog", {}, own, "Scene"),
        row("ctrl+shift+c", "view.copy_picture", {}, own, "Scene"),
        row("ctrl+shift+p", "view.video_dialog", {}, own, "Scene"),
        row("ctrl+q", "quit", {{"unsaved", "ask"}}, own, "Scene", shown, typing),
        row("ctrl+z", "undo", {{"ask", true}}, own, "Edit", shown, false, again),
        row("ctrl+shift+z", "redo", {{"ask", true}}, own, "Edit", shown, false, again),
        row("ctrl+y", "redo", {{"ask", true}}, own, "Edit", hidden, false, again),
        row("ctrl+v", "paste", {}, own, "Edit"),
        row("f", "camera.frame", {{"what", "selection"}}, "Frame selection", "View"),
        row("home", "camera.frame", {{"what", "all"}}, "Frame all", "View"),
        row("1", "camera.view", {{"name", "front"}}, "Front", "View"),
        row("3", "camera.view", {{"name", "side"}}, "Side", "View"),
        row("7", "camera.view", {{"name", "top"}}, "Top", "View"),
        row("5", "camera.orthographic", {}, own, "View"),
        row("l", "view.labels", {}, own, "View"),
        row("t", "view.theme", {}, own, "View"),
        row("f9", "view.panels", {}, own, "View"),
        row("space", "time.toggle", {}, own, "Time"),
        row(".", "time.step", {}, own, "Time", shown, false, again),
        row("?", "view.help", {}, own, last_section),
        row("f1", "view.help", {}, own, last_section, hidden, typing),
        row("f2", "view.card", {}, own, last_section, shown, typing),
        row("ctrl+k", "view.palette", {}, own, last_section, shown, typing),
        row("ctrl+,", "view.settings", {}, own, last_section),
        row("escape", "view.close", {}, own, last_section, hidden, typing),
    };
}

struct Binding {
    MousePreset preset;
    MouseButton button;
    HeldKeys held;
    MouseAction action;
};

constexpr Binding bindings[] = {
    {MousePreset::Tendril, MouseButton::Right, {}, MouseAction::Orbit},
    {MousePreset::Tendril, MouseButton::Left, {.alt = true}, MouseAction::Orbit},
    {MousePreset::Tendril, MouseButton::Middle, {}, MouseAction::Pan},
    {MousePreset::Tendril, MouseButton::Right, {.shift = true}, MouseAction::Pan},
    {MousePreset::Blender, MouseButton::Middle, {}, MouseAction::Orbit},
    {MousePreset::Blender, MouseButton::Left, {.alt = true}, MouseAction::Orbit},
    {MousePreset::Blender, MouseButton::Middle, {.shift = true}, MouseAction::Pan},
    {MousePreset::Blender, MouseButton::Middle, {.ctrl = true}, MouseAction::Zoom},
    {MousePreset::Maya, MouseButton::Left, {.alt = true}, MouseAction::Orbit},
    {MousePreset::Maya, MouseButton::Middle, {.alt = true}, MouseAction::Pan},
    {MousePreset::Maya, MouseButton::Middle, {}, MouseAction::Pan},
    {MousePreset::Maya, MouseButton::Right, {.alt = true}, MouseAction::Zoom},
};

/// "Shift+right", with a `space` before "drag".
std::string gesture(const Binding& binding, const char* space) {
    const std::string name = std::string(binding.held.shift ? "Shift+" : "") +
                             (binding.held.ctrl ? "Ctrl+" : "") + (binding.held.alt ? "Alt+" : "") +
                             button_name(binding.button) + space + "drag";
    return capitalised(name);
}

/// The preset's first gesture for the action.
std::string first_gesture(MousePreset preset, MouseAction action) {
    for (const Binding& binding : bindings)
        if (binding.preset == preset && binding.action == action) return gesture(binding, "-");
    return {};
}

/// "Right drag, Alt+left drag"; empty if there is none.
std::string gestures_of(MousePreset preset, MouseAction action) {
    std::string text;
    for (const Binding& binding : bindings)
        if (binding.preset == preset && binding.action == action)
            text += (text.empty() ? "" : ", ") + gesture(binding, " ");
    return text;
}

}  // namespace

Shortcuts::Shortcuts(const Labs& labs, const CommandTable& commands) : rows_(common_rows()) {
    for (const auto& lab : labs.all()) {
        for (Shortcut row : lab->shortcuts()) {
            row.lab = lab->name();
            add(std::move(row));
        }
        mouse_.push_back({lab->name(), lab->mouse_help()});
    }
    for (Shortcut& row : rows_)
        if (const Command* command = commands.find(row.command); command != nullptr && row.title.empty())
            row.title = command->title;
}

void Shortcuts::add(Shortcut row) {
    const auto in = [](const std::string& section) {
        return [section](const Shortcut& each) { return each.section == section; };
    };
    const auto last = std::find_if(rows_.rbegin(), rows_.rend(), in(row.section));
    const auto at =
        last != rows_.rend() ? last.base() : std::find_if(rows_.begin(), rows_.end(), in(last_section));
    rows_.insert(at, std::move(row));
}

const Shortcut* Shortcuts::find(const Chord& chord, std::string_view lab) const {
    const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const Shortcut& row) {
        return row.chord == chord && (row.lab.empty() || row.lab == lab);
    });
    return found == rows_.end() ? nullptr : &*found;
}

std::string Shortcuts::keys_for(std::string_view command) const {
    for (const Shortcut& row : rows_)
        if (row.command == command) return chord_label(row.chord);
    return {};
}

std::string Shortcuts::all_keys_for(const Shortcut& wanted) const {
    std::string keys;
    for (const Shortcut& row : rows_) {
        const std::string key = chord_label(row.chord);
        if (row.title != wanted.title || keys == key) continue;  // or the same key in another lab
        keys += (keys.empty() ? "" : ", ") + key;
    }
    return keys;
}

std::vector<MouseHelp> Shortcuts::mouse_help(std::string_view lab, MousePreset preset, Scroll scroll) const {
    const std::string zoom = gestures_of(preset, MouseAction::Zoom);
    std::vector<MouseHelp> list{
        {"Left drag on a handle", "moves it, in the plane of the view"},
        {"X, Y or Z held", "moves it along that axis"},
        {"Shift held", "moves it in the ground plane"},
        {"Left click", "selects"},
        {"Left drag on nothing, " + gestures_of(preset, MouseAction::Orbit), "turns the view"},
        {"Left drag on nothing in 2D, " + gestures_of(preset, MouseAction::Pan), "shifts the view"},
        {(scroll == Scroll::Pan ? "Ctrl+wheel" : "Wheel") + (zoom.empty() ? zoom : ", " + zoom),
         "zooms to the cursor"},
        scroll == Scroll::Pan ? MouseHelp{"Two fingers on a touchpad, wheel", "shifts the view"}
                              : MouseHelp{"Two fingers sideways, tilted wheel", "shifts the view sideways"},
        {"Click on an axis in the corner", "looks from there"},
        {"File dropped on the window", "opens it in its lab"},
        {"Click on a number", "types another: 1/3, 2*pi, 30 cm"},
        {"Drag a number sideways", "changes it; with Shift finer"},
    };
    for (const LabHelp& each : mouse_)
        if (lab.empty() || each.lab == lab) list.insert(list.end(), each.rows.begin(), each.rows.end());
    return list;
}

std::string Shortcuts::markdown() const {
    std::string text = "| keys | action |\n| --- | --- |\n";
    std::vector<std::string> done;
    for (const Shortcut& row : rows_) {
        if (std::find(done.begin(), done.end(), row.title) != done.end()) continue;
        done.push_back(row.title);
        text += "| " + all_keys_for(row) + " | " + row.title + " |\n";
    }
    text += "\n| mouse | action |\n| --- | --- |\n";
    for (const MouseHelp& help : mouse_help()) text += "| " + help.gesture + " | " + help.effect + " |\n";
    return text;
}

MousePreset mouse_preset(const Settings& settings) {
    return static_cast<MousePreset>(mouse_setting().chosen(settings));
}

Scroll scroll_action(const Settings& settings) {
    return static_cast<Scroll>(scroll_setting().chosen(settings));
}

std::optional<MouseAction> mouse_action(MousePreset preset, MouseButton button, HeldKeys held) {
    for (const Binding& binding : bindings)
        if (binding.preset == preset && binding.button == button && binding.held == held)
            return binding.action;
    return std::nullopt;
}

std::string view_hint(const Settings& settings, bool by_finger, bool brief) {
    if (by_finger) return "One finger turns the view, two move and zoom it.";
    const MousePreset preset = mouse_preset(settings);
    std::string pan = first_gesture(preset, MouseAction::Pan);
    if (!pan.starts_with("Alt") && !pan.starts_with("Shift"))
        pan[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(pan[0])));
    const std::string more = brief ? ""
                             : scroll_action(settings) == Scroll::Pan
                                 ? ", two fingers shift it; with Ctrl they zoom"
                                 : ", " + pan + " shifts it, the wheel zooms";
    return first_gesture(preset, MouseAction::Orbit) + " turns the view" + more + ". ? shows every key.";
}

}  // namespace tendril::app
