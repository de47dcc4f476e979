// Pictures and videos of the view: what was requested, and the progress of a video.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

namespace tendril::app {

struct Workspace;

/// How the view is drawn.
struct PictureLook {
    glm::ivec2 size{0};  ///< pixels; 0: as large as the view
    bool transparent = false;
    bool paper = false;          ///< in the light theme's colours, on white unless transparent
    bool handles = false;        ///< with the handles, and the selection marked
    std::optional<bool> labels;  ///< with its labels, titles and legend; empty: if the lab wants them
};

/// A picture on its way to a file or to the clipboard.
struct PictureRequest : PictureLook {
    std::filesystem::path path;  ///< empty: to the clipboard
};

/// A video: of the last seconds, or of frames that a lab shows one by one.
struct VideoRequest : PictureLook {
    std::filesystem::path path;
    std::string command = "view.video";  ///< the command that asked for it, for messages
    int from = 0;                        ///< ticks of 1/60 s before the newest moment in Rewind
    int to = 0;                          ///< likewise, less than `from`
    int every = 2;                       ///< ticks from one frame to the next
    double speed = 1.0;                  ///< playback speed; 0.5 is slow motion

    /// Set for frames that a lab shows instead of the last seconds: their number, and the function that shows
    /// one in a copy of the workspace. It returns false if the frame looks like the one before.
    int shown_frames = 0;
    std::function<bool(Workspace&, int frame)> show{};

    int frames() const { return show ? shown_frames : (from - to) / every + 1; }
};

/// Progress of the video being written.
struct VideoProgress {
    std::string name;  ///< the file's name
    int done = 0, frames = 0;
};

}  // namespace tendril::app
