#include "app/io/mp4.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace tendril::app {
namespace {

constexpr double max_encoder_end = 120.0;  ///< seconds that ffmpeg may take to finish

std::vector<std::string> command(const VideoFormat& format, const std::filesystem::path& file) {
    const FrameTime time = frame_time(format);
    const std::string size = std::to_string(format.size.x) + "x" + std::to_string(format.size.y);
    const std::string rate = std::to_string(time.denominator) + "/" + std::to_string(time.numerator);
    // A format that players on every system accept. With the prefix "file:" a name may contain colons.
    return {find_program("ffmpeg").string(),
            "-hide_banner",
            "-nostdin",
            "-loglevel",
            "error",
            "-f",
            "rawvideo",
            "-pixel_format",
            "rgba",
            "-video_size",
            size,
            "-framerate",
            rate,
            "-i",
            "pipe:0",
            "-vf",
            "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "bt709",
            "-color_range",
            "tv",
            "-c:v",
            "libx264",
            "-preset",
            "fast",
            "-crf",
            "18",
            "-movflags",
            "+faststart",
            "-f",
            "mp4",
            "-y",
            "file:" + std::filesystem::absolute(file).string()};
}

std::vector<std::string> reading_command(const std::filesystem::path& file) {
    return {find_program("ffmpeg").string(),
            "-hide_banner",
            "-nostdin",
            "-loglevel",
            "error",
            "-xerror",
            "-f",
            "mp4",
            "-i",
            "file:" + std::filesystem::absolute(file).string(),
            "-f",
            "null",
            "-"};
}

}  // namespace

std::string why_no_mp4() {
    return find_program("ffmpeg").empty() ? "to write MP4, install ffmpeg" : "";
}

Mp4File::Mp4File(const std::filesystem::path& path, const VideoFormat& format)
    : VideoFile(path), format_(format), ffmpeg_(command(format, file_.beside())) {}

void Mp4File::add(const Image& frame) {
    if (frame.size != format_.size) throw std::runtime_error("a frame differs in size from the video");
    if (frames_ == format_.frames) throw std::runtime_error("there is one frame too many");
    ffmpeg_.write({reinterpret_cast<const char*>(frame.rgba.data()), frame.rgba.size()});
    ++frames_;
}

/// Seconds left to wait for ffmpeg.
double Mp4File::seconds_left() {
    using Time = std::chrono::steady_clock;
    using Seconds = std::chrono::duration<double>;
    if (!ends_by_)
        ends_by_ = Time::now() + std::chrono::duration_cast<Time::duration>(Seconds(max_encoder_end));
    return std::max(0.0, Seconds(*ends_by_ - Time::now()).count());
}

void Mp4File::begin_reading() {
    if (!reader_ && ffmpeg_.ended_after_input() && ffmpeg_.succeeded())
        ends_by_.reset(), reader_.emplace(reading_command(file_.beside()));  // the same time again to read it
}

bool Mp4File::waits() {
    begin_reading();
    const bool ended = reader_ ? reader_->ended_after_input() : ffmpeg_.ended_after_input();
    return !ended && seconds_left() > 0.0;
}

void Mp4File::finish() {
    if (frames_ != format_.frames)
        throw std::runtime_error("only " + std::to_string(frames_) + " of " + std::to_string(format_.frames) +
                                 " frames");
    ffmpeg_.finish(seconds_left());
    begin_reading();
    reader_->finish(seconds_left());
}

}  // namespace tendril::app
