// Commands of the camera: camera.*. They frame what a lab shows, so they stand beside the labs.
#pragma once

#include "app/labs/labs.hpp"

namespace tendril::app {

/// Whose way of turning and shifting the view with the mouse is followed.
LabSetting mouse_setting();
/// What the wheel, or two fingers on a touchpad, do in the view.
LabSetting scroll_setting();

/// `labs` must outlive the table.
void add_camera_commands(CommandTable& table, const Labs& labs);

}  // namespace tendril::app
