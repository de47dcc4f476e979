// MP4 with H.264 video, which everything plays, written through a pipe by ffmpeg if that is installed. ffmpeg
// may exit successfully after a failed write, so it then reads the whole file back; only then is the old file
// replaced. Colour has half the resolution (4:2:0), and there is no alpha channel.
#pragma once

#include <chrono>
#include <optional>

#include "app/io/child_process.hpp"
#include "app/io/video_file.hpp"

namespace tendril::app {

/// "to write MP4, install ffmpeg", or empty if it is installed.
std::string why_no_mp4();

/// Width and height must be even.
class Mp4File final : public VideoFile {
  public:
    Mp4File(const std::filesystem::path& path, const VideoFormat& format);
    void add(const Image& frame) override;
    bool by_another_program() const override { return true; }
    bool waits() override;
    void finish() override;

  private:
    VideoFormat format_;
    ChildProcess ffmpeg_;                 ///< destroyed before the file that it writes
    std::optional<ChildProcess> reader_;  ///< set once ffmpeg_ has succeeded
    int frames_ = 0;
    std::optional<std::chrono::steady_clock::time_point> ends_by_;  ///< set once it has all frames

    double seconds_left();
    /// Starts reading it back, unless ffmpeg_ has failed or is still running.
    void begin_reading();
};

}  // namespace tendril::app
