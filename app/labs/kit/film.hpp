// Shared by commands that write a video: arguments for its file, size and look.
#pragma once

#include <string>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/workspace.hpp"
#include "app/io/video_file.hpp"

namespace tendril::app {

/// path, then the arguments of a picture, then `more`. With `may_name` the path may be omitted in a window.
std::vector<Argument> film_arguments(std::vector<Argument> more, bool may_name = false);
/// "MP4 has no transparency, animated PNG has"
std::string no_transparency(const VideoKind& kind);
/// The request without its frames. A new file is called "<scene>-<what>-1.png". Throws Refused if another
/// video is being written, or the file cannot be written.
VideoRequest film_request(Workspace& workspace, const Arguments& given, const std::string& what = {});

}  // namespace tendril::app
