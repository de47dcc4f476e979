// A video of the last seconds: what it is to be, and how far it has come.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

namespace tendril::app {

struct VideoRequest {
    std::filesystem::path path;
    glm::ivec2 size{0};  ///< pixels; 0: as large as the view
    int from = 0;        ///< ticks of 1/60 s before the last moment that is remembered
    int to = 0;          ///< likewise, less than `from`
    int every = 2;       ///< ticks from one frame to the next
    double speed = 1.0;  ///< of what is shown; 0.5 is slow motion
    bool transparent = false;

    int frames() const { return (from - to) / every + 1; }
};

/// Of the video that is being written.
struct VideoProgress {
    std::string name;  ///< the file's
    int done = 0, frames = 0;
};

}  // namespace tendril::app
