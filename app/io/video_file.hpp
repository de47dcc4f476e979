// A video on its way to a file, one frame after another. Each way to write one (apng.hpp, mp4.hpp) derives
// from this.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>

#include "app/io/image.hpp"

namespace tendril::app {

struct VideoFormat {
    glm::ivec2 size{0};        ///< of every frame, in pixels
    int frames = 0;            ///< how many there will be, 1 or more
    int every = 2;             ///< ticks of 1/60 s from one frame to the next: 1 to 60
    double speed = 1.0;        ///< 0.05 to 2: in slow motion a frame stays longer
    bool transparent = false;  ///< frames have an alpha channel; else it is ignored
};

/// How long a frame is shown: `numerator` / `denominator` seconds, each below 65536.
struct FrameTime {
    unsigned numerator = 2, denominator = 60;
};
FrameTime frame_time(const VideoFormat& format);

/// What throws does so with std::runtime_error, which says why. The file is there after finish();
/// destroyed before that, it leaves nothing behind.
class VideoFile {
  public:
    virtual ~VideoFile() = default;
    /// Throws where the frame has another size than the video, or is one too many.
    virtual void add(const Image& frame) = 0;
    /// How long that takes for the last of the file is its own business.
    virtual bool by_another_program() const { return false; }
    /// After the last frame: whether finish() would still have to wait for it.
    virtual bool waits() { return false; }
    /// After the last frame. Waits for what is left to do; then the file is there. Throws where a frame is
    /// missing.
    virtual void finish() = 0;
};

/// Why a video of this name can't be written; empty where it can. The ending decides: .png, or .mp4 where
/// ffmpeg is installed.
std::string why_no_video(const std::filesystem::path& path);

/// Throws where the file can't be made, or why_no_video() says so.
std::unique_ptr<VideoFile> open_video(const std::filesystem::path& path, const VideoFormat& format);

}  // namespace tendril::app
