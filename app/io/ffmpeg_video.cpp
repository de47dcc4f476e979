#include "app/io/ffmpeg_video.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace tendril::app {
namespace {

constexpr double max_encoder_end = 120.0;  ///< seconds that ffmpeg may take to finish

/// MP4 as players on every system accept it. Each frame of a GIF has a palette of its own, so that ffmpeg
/// need not keep them all.
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
        ends_by_.reset(),  // the same time again to read it
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
