// Arguments shared by the commands for pictures and videos of the view.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/video_request.hpp"

namespace tendril::app {

/// `first`, then the members of PictureLook.
std::vector<Argument> picture_arguments(std::vector<Argument> first = {});
void set_look(const Arguments& given, PictureLook& look);

/// An unused name beside the scene's file, or in the working directory: "arm-1.png"; with `what`, for a
/// picture of something other than the view: "arm-race-1.png". Throws Refused outside a window, where a
/// script has to give the path.
std::filesystem::path new_file(const Workspace& workspace, const std::string& what = {},
                               const char* extension = ".png");

}  // namespace tendril::app
