#include "app/shell/shortcuts.hpp"

#include <algorithm>

namespace tendril::app {
namespace {

Shortcut row(const char* chord, const char* command, ArgumentList arguments, const char* title,
             Section section, bool in_menu = true, bool while_typing = false) {
    const std::string_view name = command;
    const bool repeats = name == "undo" || name == "redo" || name == "time.step" || name == "microscope.step";
    return {*chord_from_name(chord),
            command,
            std::move(arguments),
            title,
            section,
            in_menu,
            while_typing,
            repeats};
}

Shortcut in_lab(const char* lab, Shortcut shortcut) {
    shortcut.lab = lab;
    return shortcut;
}

constexpr MouseBinding mouse_bindings[] = {
    {MouseButton::Right, false, false, MouseAction::Orbit},
    {MouseButton::Left, false, true, MouseAction::Orbit},
    {MouseButton::Middle, false, false, MouseAction::Pan},
    {MouseButton::Right, true, false, MouseAction::Pan},
};

std::string gesture_name(const MouseBinding& binding) {
    const char* button = binding.button == MouseButton::Left    ? "left drag"
                         : binding.button == MouseButton::Right ? "right drag"
                                                                : "middle drag";
    std::string name = std::string(binding.shift ? "Shift+" : "") + (binding.alt ? "Alt+" : "") + button;
    name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
}

std::string gestures_of(MouseAction action) {
    std::string text;
    for (const auto& binding : mouse_bindings) {
        if (binding.action == action) text += (text.empty() ? "" : ", ") + gesture_name(binding);
    }
    return text;
}

}  // namespace

const char* section_title(Section section) {
    switch (section) {
        case Section::Scene:
            return "Scene";
        case Section::Edit:
            return "Edit";
        case Section::View:
            return "View";
        case Section::Time:
            return "Time";
        case Section::Microscope:
            return "Microscope";
        case Section::Help:
            return "Help";
    }
    return "";
}

const std::vector<Shortcut>& shortcuts() {
    static const std::vector<Shortcut> table{
        row("ctrl+n", "scene.new", {}, "New scene", Section::Scene),
        row("ctrl+o", "scene.open_dialog", {}, "Open...", Section::Scene),
        row("ctrl+s", "scene.save_dialog", {{"ask", false}}, "Save", Section::Scene),
        row("ctrl+shift+s", "scene.save_dialog", {{"ask", true}}, "Save as...", Section::Scene),
        row("ctrl+q", "quit", {}, "Quit", Section::Scene, true, true),
        row("ctrl+z", "undo", {}, "Undo", Section::Edit),
        row("ctrl+shift+z", "redo", {}, "Redo", Section::Edit),
        row("ctrl+y", "redo", {}, "Redo", Section::Edit, false),
        in_lab("chain", row("delete", "chain.remove_selected", {}, "Remove what is selected", Section::Edit)),
        in_lab("rope", row("delete", "rope.remove_selected", {}, "Remove what is selected", Section::Edit)),
        row("f", "camera.frame", {{"what", "selection"}}, "Frame selection", Section::View),
        row("home", "camera.frame", {{"what", "all"}}, "Frame all", Section::View),
        row("1", "camera.view", {{"name", "front"}}, "Front", Section::View),
        row("3", "camera.view", {{"name", "side"}}, "Side", Section::View),
        row("7", "camera.view", {{"name", "top"}}, "Top", Section::View),
        row("5", "camera.orthographic", {}, "Orthographic", Section::View),
        row("b", "view.segments", {}, "Bones or spheres", Section::View),
        row("l", "view.labels", {}, "Labels always", Section::View),
        row("t", "view.theme", {}, "Light or dark", Section::View),
        row("f9", "view.panels", {}, "Fold panels", Section::View),
        row("space", "time.toggle", {}, "Play or pause", Section::Time),
        row(".", "time.step", {}, "One tick", Section::Time),
        in_lab("chain", row("right", "microscope.step", {{"by", 1}}, "Microscope: a step on",
                            Section::Microscope, false)),
        in_lab("chain", row("left", "microscope.step", {{"by", -1}}, "Microscope: a step back",
                            Section::Microscope, false)),
        in_lab("chain", row("shift+right", "microscope.step", {{"iterations", 1}},
                            "Microscope: an iteration on", Section::Microscope, false)),
        in_lab("chain", row("shift+left", "microscope.step", {{"iterations", -1}},
                            "Microscope: an iteration back", Section::Microscope, false)),
        row("?", "view.help", {}, "Keys and mouse", Section::Help),
        row("f1", "view.help", {}, "Keys and mouse", Section::Help, false, true),
        row("ctrl+k", "view.palette", {}, "Find a command", Section::Help, true, true),
        row("ctrl+,", "view.settings", {}, "Settings", Section::Help),
        row("escape", "view.close", {}, "Close, or let go", Section::Help, false, true),
    };
    return table;
}

const Shortcut* find_shortcut(const Chord& chord, std::string_view lab) {
    const auto found = std::find_if(shortcuts().begin(), shortcuts().end(), [&](const Shortcut& shortcut) {
        return shortcut.chord == chord && (shortcut.lab.empty() || shortcut.lab == lab);
    });
    return found == shortcuts().end() ? nullptr : &*found;
}

std::string keys_for(std::string_view command) {
    for (const auto& shortcut : shortcuts()) {
        if (shortcut.command == command) return chord_label(shortcut.chord);
    }
    return {};
}

std::optional<MouseAction> mouse_action(MouseButton button, bool shift, bool alt) {
    for (const auto& binding : mouse_bindings) {
        if (binding.button == button && binding.shift == shift && binding.alt == alt) return binding.action;
    }
    return std::nullopt;
}

std::string all_keys_for(const Shortcut& wanted) {
    std::string keys;
    for (const auto& shortcut : shortcuts()) {
        const std::string key = chord_label(shortcut.chord);
        if (shortcut.title != wanted.title || keys == key) continue;  // the same key in another lab
        keys += (keys.empty() ? "" : ", ") + key;
    }
    return keys;
}

const std::vector<MouseHelp>& mouse_help() {
    static const std::vector<MouseHelp> list{
        {"Left drag on a handle", "moves it, in the plane of the view"},
        {"X, Y or Z held", "moves it along that axis"},
        {"Shift held", "moves it in the ground plane"},
        {"Left click", "selects"},
        {gestures_of(MouseAction::Orbit), "turns the view"},
        {gestures_of(MouseAction::Pan), "shifts the view"},
        {"Wheel", "zooms to the cursor"},
        {"File dropped on the window", "opens it"},
    };
    return list;
}

std::string shortcuts_markdown() {
    std::string text = "| keys | what they do |\n| --- | --- |\n";
    std::vector<std::string> done;
    for (const auto& shortcut : shortcuts()) {
        if (std::find(done.begin(), done.end(), shortcut.title) != done.end()) continue;
        done.push_back(shortcut.title);
        text += "| " + all_keys_for(shortcut) + " | " + shortcut.title + " |\n";
    }
    text += "\n| mouse | what it does |\n| --- | --- |\n";
    for (const auto& help : mouse_help()) text += "| " + help.gesture + " | " + help.effect + " |\n";
    return text;
}

}  // namespace tendril::app
