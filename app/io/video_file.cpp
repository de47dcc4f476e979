#include "app/io/video_file.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/io/apng.hpp"
#include "app/system/child_process.hpp"

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

namespace {

constexpr double max_encoder_end = 120.0;  ///< seconds that ffmpeg may take to finish

/// MP4 in the form that players on every system accept. Each frame of a GIF has its own palette, so that
/// ffmpeg need not keep all frames.
constexpr const char* to_mp4 =
    "-vf scale=out_color_matrix=bt709:out_range=tv,format=yuv420p -colorspace bt709 -color_primaries bt709 "
    "-color_trc bt709 -color_range tv -c:v libx264 -preset fast -crf 18 -movflags +faststart -f mp4 -y";
constexpr const char* to_gif =
    "-vf format=rgb24,split[a][b];[a]palettegen=stats_mode=single[p];"
    "[b][p]paletteuse=new=1:dither=bayer:bayer_scale=4 -f gif -y";

/// ffmpeg with these arguments, separated by spaces, before and after the file.
std::vector<std::string> ffmpeg(const std::string& before, const std::filesystem::path& file,
                                const std::string& after = {}) {
    std::vector<std::string> all{find_program("ffmpeg").string()};
    const auto add = [&](const std::string& words) {
        std::istringstream stream(words);
        all.insert(all.end(), std::istream_iterator<std::string>(stream), {});
    };
    add("-hide_banner -nostdin -loglevel error " + before);
    all.push_back("file:" + std::filesystem::absolute(file).string());  // the name may then contain colons
    add(after);
    return all;
}

std::vector<std::string> writing(const VideoFormat& format, const char* to,
                                 const std::filesystem::path& file) {
    const FrameTime time = frame_time(format);
    return ffmpeg("-f rawvideo -pixel_format rgba -video_size " + std::to_string(format.size.x) + "x" +
                      std::to_string(format.size.y) + " -framerate " + std::to_string(time.denominator) +
                      "/" + std::to_string(time.numerator) + " -i pipe:0 " + to,
                  file);
}

}  // namespace

FfmpegVideo::FfmpegVideo(const std::filesystem::path& path, const VideoFormat& format)
    : VideoFile(path),
      format_(format),
      gif_(path.extension() == ".gif"),
      ffmpeg_(writing(format, gif_ ? to_gif : to_mp4, file_.beside())) {}

void FfmpegVideo::add(const Image& frame) {
    if (frame.size != format_.size) throw std::runtime_error("a frame differs in size from the video");
    if (frames_ == format_.frames) throw std::runtime_error("there is one frame too many");
    ffmpeg_.write({reinterpret_cast<const char*>(frame.rgba.data()), frame.rgba.size()});
    ++frames_;
}

/// Seconds left to wait for ffmpeg.
double FfmpegVideo::seconds_left() {
    using Time = std::chrono::steady_clock;
    using Seconds = std::chrono::duration<double>;
    if (!ends_by_)
        ends_by_ = Time::now() + std::chrono::duration_cast<Time::duration>(Seconds(max_encoder_end));
    return std::max(0.0, Seconds(*ends_by_ - Time::now()).count());
}

void FfmpegVideo::begin_reading() {
    if (!reader_ && ffmpeg_.ended_after_input() && ffmpeg_.succeeded())
        ends_by_.reset(),  // the same time again to read it back
            reader_.emplace(
                ffmpeg(gif_ ? "-xerror -f gif -i" : "-xerror -f mp4 -i", file_.beside(), "-f null -"));
}

bool FfmpegVideo::waits() {
    begin_reading();
    const bool ended = reader_ ? reader_->ended_after_input() : ffmpeg_.ended_after_input();
    return !ended && seconds_left() > 0.0;
}

void FfmpegVideo::finish() {
    if (frames_ != format_.frames)
        throw std::runtime_error("only " + std::to_string(frames_) + " of " + std::to_string(format_.frames) +
                                 " frames");
    ffmpeg_.finish(seconds_left());
    begin_reading();
    reader_->finish(seconds_left());
}

}  // namespace tendril::app
