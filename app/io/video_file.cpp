#include "app/io/video_file.hpp"

#include <cmath>
#include <stdexcept>

#include "app/io/apng.hpp"
#include "app/io/mp4.hpp"

namespace tendril::app {

FrameTime frame_time(const VideoFormat& format) {
    const auto every = static_cast<unsigned>(format.every);
    if (format.speed == 1.0) return {every, 60};
    // The speed is exact to 0.01 %.
    return {100 * every, static_cast<unsigned>(std::lround(6000.0 * format.speed))};
}

std::string why_no_video(const std::filesystem::path& path) {
    const std::filesystem::path ending = path.extension();
    if (ending == ".png") return {};
    if (ending == ".mp4") return why_no_mp4();
    return "path must end in .png or .mp4, got " + path.string();
}

std::unique_ptr<VideoFile> open_video(const std::filesystem::path& path, const VideoFormat& format) {
    if (const std::string why = why_no_video(path); !why.empty()) throw std::runtime_error(why);
    if (path.extension() == ".mp4") return std::make_unique<Mp4File>(path, format);
    return std::make_unique<ApngFile>(path, format);
}

}  // namespace tendril::app
