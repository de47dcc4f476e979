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

// What Esc does: closes what lies over the scene, or else selects nothing.

class CommandTable;
class Labs;

/// The labs must outlive what it adds.
void add_closing_command(CommandTable& table, const Labs& labs);

class CommandTable;
class Labs;

/// view.video, view.video_dialog, view.end_video and view.copy_picture. `labs` must outlive the table.
void add_video_commands(CommandTable& table, const Labs& labs);

}  // namespace tendril::app
