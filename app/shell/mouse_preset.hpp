// Mouse bindings for the camera: Tendril's own, or the ones a user knows from another program.
#pragma once

#include <optional>
#include <string>

#include "app/document/settings.hpp"
#include "app/labs/kit/setting.hpp"
#include "app/window/event.hpp"

namespace tendril::app {

enum class MousePreset { Tendril, Blender, Maya };
MousePreset mouse_preset(const Settings& settings);

/// The effect of the wheel, or two fingers on a touchpad, in the view. Pan: they zoom while Ctrl is held.
enum class Scroll { Zoom, Pan };
Scroll scroll_action(const Settings& settings);

enum class MouseAction { Orbit, Pan, Zoom };
struct HeldKeys {
    bool shift = false, ctrl = false, alt = false;
    bool operator==(const HeldKeys&) const = default;
};
/// The effect of a drag with that button; none if it acts on handles. A left drag that begins on empty space
/// orbits, in every preset.
std::optional<MouseAction> mouse_action(MousePreset preset, MouseButton button, HeldKeys held);

/// "Right drag, Alt+left drag"; empty if there is none.
std::string gestures_of(MousePreset preset, MouseAction action);
/// "Right-drag turns the view, middle-drag shifts it, the wheel zooms."
std::string view_hint(MousePreset preset, Scroll scroll = Scroll::Zoom);
/// "Right-drag turns the view."
std::string orbit_hint(MousePreset preset);

}  // namespace tendril::app
