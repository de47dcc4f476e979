#pragma once

namespace tendril::app {

class CommandTable;
class Labs;

/// view.video, view.video_dialog, view.end_video and view.copy_picture. `labs` must outlive the table.
void add_video_commands(CommandTable& table, const Labs& labs);

}  // namespace tendril::app
