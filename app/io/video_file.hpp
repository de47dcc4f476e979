// Writes a video to a file, frame by frame. Each format derives from this: apng.hpp, mp4.hpp, and those that
// ffmpeg writes.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>

#include "app/io/image.hpp"
#include "app/system/atomic_file.hpp"
#include "app/system/child_process.hpp"

namespace tendril::app {

struct VideoFormat {
    glm::ivec2 size{0};        ///< of every frame, pixels
    int frames = 0;            ///< total, 1 or more
    int every = 2;             ///< ticks of 1/60 s from one frame to the next: 1 to 60
    double speed = 1.0;        ///< 0.05 to 2; in slow motion frames last longer
    bool transparent = false;  ///< frames have an alpha channel; otherwise alpha is ignored
};

/// Duration of a frame: `numerator` / `denominator` seconds, each below 65536.
struct FrameTime {
    unsigned numerator = 2, denominator = 60;
};
FrameTime frame_time(const VideoFormat& format);

/// Errors are std::runtime_error with the reason. The file exists after commit(); if destroyed before that,
/// it leaves no file.
class VideoFile {
  public:
    virtual ~VideoFile() = default;
    /// Throws if the frame's size differs from the video's, or there are too many frames.
    virtual void add(const Image& frame) = 0;
    /// True if another program writes the file, so that the time to finish is unpredictable.
    virtual bool by_another_program() const { return false; }
    /// After the last frame: whether finish() would have to wait for that program.
    virtual bool waits() { return false; }
    /// Call after the last frame. Waits until the file is complete. Throws if a frame is missing.
    virtual void finish() = 0;
    /// After finish(): replaces an earlier file of that name, or takes another name in the same folder.
    void commit(const std::filesystem::path& other = {}) { file_.commit(other); }

  protected:
    explicit VideoFile(const std::filesystem::path& path) : file_(path) {}
    AtomicFile file_;
};

/// A format, chosen by the ending of the file's name.
struct VideoKind {
    const char* ending;  ///< ".gif"
    const char* title;   ///< "GIF"
    double max_rate;     ///< frames a second; viewers slow down above it
    bool needs_ffmpeg = true;
    bool transparent = false;  ///< has an alpha channel
    bool even = false;         ///< width and height must be even
};
inline constexpr std::array<VideoKind, 3> video_kinds{{{".png", "animated PNG", 60.0, false, true, false},
                                                       {".gif", "GIF", 50.0},
                                                       {".mp4", "MP4", 120.0, true, false, true}}};
/// Null if the name has no known ending.
const VideoKind* video_kind(const std::filesystem::path& path);

/// "to write GIF, install ffmpeg"; empty if such videos can be written.
std::string why_no_video(const VideoKind& kind);
/// Why a video of this name cannot be written; empty if it can.
std::string why_no_video(const std::filesystem::path& path);

/// Throws if the file cannot be created, or for the reason of why_no_video().
std::unique_ptr<VideoFile> open_video(const std::filesystem::path& path, const VideoFormat& format);

/// Videos that ffmpeg writes through a pipe, if it is installed: MP4 with H.264, which every player supports,
/// and GIF. ffmpeg may exit successfully after a failed write, so it then reads the whole file back before
/// the old file is replaced. MP4 has colour at half the resolution (4:2:0); each frame of a GIF has its own
/// 256 colours. Neither has partial transparency.
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
    ChildProcess ffmpeg_;                 ///< must be destroyed before the file that it writes
    std::optional<ChildProcess> reader_;  ///< set once ffmpeg_ has succeeded
    int frames_ = 0;
    std::optional<std::chrono::steady_clock::time_point> ends_by_;  ///< set once ffmpeg_ has all frames

    double seconds_left();
    /// Starts reading it back, unless ffmpeg_ has failed or is still running.
    void begin_reading();
};

}  // namespace tendril::app
