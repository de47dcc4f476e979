// What the mouse does in the empty view, or over anything: Tendril's own way, or that of a program which a
// person is used to.
#pragma once

#include <optional>
#include <string>

#include "app/document/settings.hpp"
#include "app/labs/kit/setting.hpp"
#include "app/window/event.hpp"

namespace tendril::app {

enum class MousePreset { Tendril, Blender, Maya };
MousePreset mouse_preset(const Settings& settings);

/// What the wheel does in the view, or two fingers on a touchpad. Where they pan, they zoom while Ctrl is
/// held.
enum class Scroll { Zoom, Pan };
Scroll scroll_action(const Settings& settings);

enum class MouseAction { Orbit, Pan, Zoom };
struct HeldKeys {
    bool shift = false, ctrl = false, alt = false;
    bool operator==(const HeldKeys&) const = default;
};
/// What a drag with that button does; nothing where it is for handles. A left drag that begins on nothing
/// orbits, in every preset.
std::optional<MouseAction> mouse_action(MousePreset preset, MouseButton button, HeldKeys held);

/// "Right drag, Alt+left drag"; empty where none does.
std::string gestures_of(MousePreset preset, MouseAction action);
/// "Right-drag turns the view, middle-drag shifts it, the wheel zooms."
std::string view_hint(MousePreset preset, Scroll scroll = Scroll::Zoom);
/// "Right-drag turns the view."
std::string orbit_hint(MousePreset preset);

}  // namespace tendril::app
