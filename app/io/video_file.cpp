#include "app/io/video_file.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/io/apng.hpp"
#include "app/system/child_process.hpp"
#include "app/io/ffmpeg_video.hpp"

namespace tendril::app {

FrameTime frame_time(const VideoFormat& format) {
    const auto every = static_cast<unsigned>(format.every);
    if (format.speed == 1.0) return {every, 60};
    // The speed is exact to 0.01 %.
    return {100 * every, static_cast<unsigned>(std::lround(6000.0 * format.speed))};
}

const VideoKind* video_kind(const std::filesystem::path& path) {
    const auto found = std::ranges::find(video_kinds, path.extension(), &VideoKind::ending);
    return found == video_kinds.end() ? nullptr : &*found;
}

std::string why_no_video(const VideoKind& kind) {
    const bool can = !kind.needs_ffmpeg || !find_program("ffmpeg").empty();
    return can ? "" : std::string("to write ") + kind.title + ", install ffmpeg";
}

std::string why_no_video(const std::filesystem::path& path) {
    const VideoKind* const kind = video_kind(path);
    return kind ? why_no_video(*kind) : "path must end in .png, .gif or .mp4, got " + path.string();
}

std::unique_ptr<VideoFile> open_video(const std::filesystem::path& path, const VideoFormat& format) {
    if (const std::string why = why_no_video(path); !why.empty()) throw std::runtime_error(why);
    if (video_kind(path)->needs_ffmpeg) return std::make_unique<FfmpegVideo>(path, format);
    return std::make_unique<ApngFile>(path, format);
}

}  // namespace tendril::app
