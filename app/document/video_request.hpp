// A video of the last seconds: what was requested, and its progress.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

namespace tendril::app {

struct VideoRequest {
    std::filesystem::path path;
    glm::ivec2 size{0};  ///< pixels; 0: as large as the view
    int from = 0;        ///< ticks of 1/60 s before the newest moment in Rewind
    int to = 0;          ///< likewise, less than `from`
    int every = 2;       ///< ticks from one frame to the next
    double speed = 1.0;  ///< of playback; 0.5 is slow motion
    bool transparent = false;

    int frames() const { return (from - to) / every + 1; }
};

/// Progress of the video being written.
struct VideoProgress {
    std::string name;  ///< the file's
    int done = 0, frames = 0;
};

}  // namespace tendril::app
