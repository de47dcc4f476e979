// Commands of the camera: camera.*. They frame what a lab shows, so they stand beside the labs.
#pragma once

#include "app/labs/labs.hpp"

namespace tendril::app {

/// `labs` must outlive the table.
void add_camera_commands(CommandTable& table, const Labs& labs);

}  // namespace tendril::app
