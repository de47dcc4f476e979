// Camera commands, camera.*: they frame what a lab shows, so they belong to the labs.
#pragma once

#include "app/labs/labs.hpp"

namespace tendril::app {

/// The mouse preset for turning and shifting the view.
LabSetting mouse_setting();
/// What the wheel, or two fingers on a touchpad, do in the view.
LabSetting scroll_setting();

/// `labs` must outlive the table.
void add_camera_commands(CommandTable& table, const Labs& labs);

class CommandTable;
class Labs;

/// view.close, for Esc: closes overlays or, if there are none, clears the selection. `labs` must outlive the
/// table.
void add_closing_command(CommandTable& table, const Labs& labs);

class CommandTable;
class Labs;

/// view.video, view.video_dialog, view.end_video and view.copy_picture. `labs` must outlive the table.
void add_video_commands(CommandTable& table, const Labs& labs);

}  // namespace tendril::app
