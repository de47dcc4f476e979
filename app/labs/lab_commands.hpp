// Commands for the view of any lab: the camera, view.close, and pictures and videos of the view.
#pragma once

#include "app/labs/labs.hpp"

namespace tendril::app {

/// The mouse preset for orbiting and panning the view.
LabSetting mouse_setting();
/// The effect of the wheel, or two fingers on a touchpad, in the view.
LabSetting scroll_setting();

/// `labs` must outlive the table.
void add_camera_commands(CommandTable& table, const Labs& labs);

/// view.close, for Esc: closes overlays or, if there are none, clears the selection. `labs` must outlive the
/// table.
void add_closing_command(CommandTable& table, const Labs& labs);

/// Pictures and videos of the view, and their dialogs. `labs` must outlive the table.
void add_video_commands(CommandTable& table, const Labs& labs);

}  // namespace tendril::app
