// Videos that ffmpeg writes through a pipe, if it is installed: MP4 with H.264, which everything plays, and
// GIF. ffmpeg may exit successfully after a failed write, so it then reads the whole file back; only then is
// the old file replaced. MP4 has colour at half the resolution (4:2:0); a frame of a GIF has 256 colours of
// its own. Neither has partial transparency.
#pragma once

#include <chrono>
#include <optional>

#include "app/system/child_process.hpp"
#include "app/io/video_file.hpp"

namespace tendril::app {

class FfmpegVideo final : public VideoFile {
  public:
    /// Width and height of an MP4 must be even.
    FfmpegVideo(const std::filesystem::path& path, const VideoFormat& format);
    void add(const Image& frame) override;
    bool by_another_program() const override { return true; }
    bool waits() override;
    void finish() override;

  private:
    VideoFormat format_;
    bool gif_;
    ChildProcess ffmpeg_;                 ///< destroyed before the file that it writes
    std::optional<ChildProcess> reader_;  ///< set once ffmpeg_ has succeeded
    int frames_ = 0;
    std::optional<std::chrono::steady_clock::time_point> ends_by_;  ///< set once it has all frames

    double seconds_left();
    /// Starts reading it back, unless ffmpeg_ has failed or is still running.
    void begin_reading();
};

}  // namespace tendril::app
