#include "app/shell/mouse_preset.hpp"

#include <cctype>

#include "app/document/text.hpp"
#include "app/labs/lab_commands.hpp"

namespace tendril::app {
namespace {

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
    const char* button = binding.button == MouseButton::Left    ? "left"
                         : binding.button == MouseButton::Right ? "right"
                                                                : "middle";
    const std::string name = std::string(binding.held.shift ? "Shift+" : "") +
                             (binding.held.ctrl ? "Ctrl+" : "") + (binding.held.alt ? "Alt+" : "") + button +
                             space + "drag";
    return capitalised(name);
}

/// The preset's first gesture for the action.
std::string first_gesture(MousePreset preset, MouseAction action) {
    for (const Binding& binding : bindings)
        if (binding.preset == preset && binding.action == action) return gesture(binding, "-");
    return {};
}

}  // namespace

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

std::string gestures_of(MousePreset preset, MouseAction action) {
    std::string text;
    for (const Binding& binding : bindings)
        if (binding.preset == preset && binding.action == action)
            text += (text.empty() ? "" : ", ") + gesture(binding, " ");
    return text;
}

std::string orbit_hint(MousePreset preset) {
    return first_gesture(preset, MouseAction::Orbit) + " turns the view.";
}

std::string view_hint(MousePreset preset, Scroll scroll) {
    if (scroll == Scroll::Pan)
        return first_gesture(preset, MouseAction::Orbit) +
               " turns the view, two fingers shift it; with Ctrl they zoom.";
    std::string pan = first_gesture(preset, MouseAction::Pan);
    if (!pan.starts_with("Alt") && !pan.starts_with("Shift"))
        pan[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(pan[0])));
    return first_gesture(preset, MouseAction::Orbit) + " turns the view, " + pan +
           " shifts it, the wheel zooms.";
}

}  // namespace tendril::app
