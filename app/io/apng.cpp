#include "app/io/apng.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace tendril::app {
namespace {

constexpr std::size_t source_channels = 4;
constexpr std::size_t max_chunk_bytes = 1u << 16;  ///< frames are compressed in chunks of at most this size
constexpr int filter_kinds = 5;

void put_32(std::string& to, std::uint32_t value) {
    for (const int shift : {24, 16, 8, 0}) to += static_cast<char>((value >> shift) & 0xff);
}

void put_16(std::string& to, unsigned value) {
    to += static_cast<char>((value >> 8) & 0xff);
    to += static_cast<char>(value & 0xff);
}

std::string head_text(const VideoFormat& format) {
    constexpr char depth = 8, colour = 2, colour_and_alpha = 6;
    std::string head;
    put_32(head, static_cast<std::uint32_t>(format.size.x));
    put_32(head, static_cast<std::uint32_t>(format.size.y));
    head += depth;
    head += format.transparent ? colour_and_alpha : colour;
    head.append(3, '\0');  // deflate, adaptive filters, not interlaced
    return head;
}

int paeth(int left, int above, int corner) {
    const int guess = left + above - corner;
    const int to_left = std::abs(guess - left), to_above = std::abs(guess - above),
              to_corner = std::abs(guess - corner);
    if (to_left <= to_above && to_left <= to_corner) return left;
    return to_above <= to_corner ? above : corner;
}

/// Applies filter `kind` of the specification's section 9 to a row; the result begins with the kind.
void filter_row(int kind, const std::vector<std::uint8_t>& row, const std::vector<std::uint8_t>& above,
                std::size_t step, std::vector<std::uint8_t>& result) {
    result[0] = static_cast<std::uint8_t>(kind);
    for (std::size_t i = 0; i < row.size(); ++i) {
        const int left = i < step ? 0 : row[i - step], up = above[i], corner = i < step ? 0 : above[i - step];
        const int guess = kind == 0   ? 0
                          : kind == 1 ? left
                          : kind == 2 ? up
                          : kind == 3 ? (left + up) / 2
                                      : paeth(left, up, corner);
        result[i + 1] = static_cast<std::uint8_t>(row[i] - guess);
    }
}

/// Estimates how badly a filtered row compresses by the specification's heuristic: the sum of its bytes'
/// magnitudes as signed numbers.
long weight(const std::vector<std::uint8_t>& row) {
    long sum = 0;
    for (std::size_t i = 1; i < row.size(); ++i) sum += std::min<int>(row[i], 256 - row[i]);
    return sum;
}

/// RAII wrapper of zlib's state.
class Deflate {
  public:
    Deflate() {
        if (deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, 15, 8, Z_FILTERED) != Z_OK)
            throw std::runtime_error("out of memory");
    }
    ~Deflate() { deflateEnd(&stream_); }
    Deflate(const Deflate&) = delete;
    Deflate& operator=(const Deflate&) = delete;

    /// Compresses all bytes, calling `take` with each part of the output.
    template <class Take>
    void run(std::vector<std::uint8_t>& bytes, const Take& take) {
        std::vector<std::uint8_t> out(max_chunk_bytes);
        std::size_t begin = 0;
        for (int result = Z_OK; result != Z_STREAM_END;) {
            if (stream_.avail_in == 0) {  // zlib counts in 32 bits
                const std::size_t more = std::min<std::size_t>(bytes.size() - begin, 1u << 30);
                stream_.next_in = bytes.data() + begin;
                stream_.avail_in = static_cast<uInt>(more);
                begin += more;
            }
            stream_.next_out = out.data();
            stream_.avail_out = static_cast<uInt>(out.size());
            result = deflate(&stream_, begin == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
            const std::size_t count = out.size() - stream_.avail_out;
            if (count > 0) take(std::string_view(reinterpret_cast<const char*>(out.data()), count));
        }
    }

  private:
    z_stream stream_{};
};

}  // namespace

ApngFile::ApngFile(const std::filesystem::path& path, const VideoFormat& format)
    : VideoFile(path), format_(format) {
    write_head();
}

void ApngFile::chunk(const char* type, std::string_view data) {
    std::string text;
    put_32(text, static_cast<std::uint32_t>(data.size()));
    text += type;
    text += data;
    const auto* const checked = reinterpret_cast<const Bytef*>(text.data()) + 4;
    put_32(text, static_cast<std::uint32_t>(crc32(0, checked, static_cast<uInt>(data.size() + 4))));
    file_.append(text);
}

void ApngFile::write_head() {
    file_.append(std::string_view("\x89PNG\r\n\x1a\n", 8));
    chunk("IHDR", head_text(format_));
    chunk("sRGB", std::string_view("\0", 1));
    std::string animation;
    put_32(animation, static_cast<std::uint32_t>(format_.frames));
    put_32(animation, 0);  // loop forever
    chunk("acTL", animation);
}

void ApngFile::write_control(const Area& area) {
    constexpr char leave = 0, replace = 0;  // keep the frame; replace alpha instead of blending
    const FrameTime time = frame_time(format_);
    std::string control;
    put_32(control, sequence_++);
    for (const int number : {area.size.x, area.size.y, area.low.x, area.low.y})
        put_32(control, static_cast<std::uint32_t>(number));
    put_16(control, time.numerator);
    put_16(control, time.denominator);
    control += leave;
    control += replace;
    chunk("fcTL", control);
}

std::vector<std::uint8_t> ApngFile::filtered(const Image& frame, const Area& area) const {
    const std::size_t step = format_.transparent ? 4 : 3, width = static_cast<std::size_t>(area.size.x);
    std::vector<std::uint8_t> row(step * width), above(row.size(), 0), all;
    std::array<std::vector<std::uint8_t>, filter_kinds> tries;
    for (auto& each : tries) each.resize(row.size() + 1);
    all.reserve(static_cast<std::size_t>(area.size.y) * (row.size() + 1));
    for (int y = area.low.y; y < area.low.y + area.size.y; ++y) {
        const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(format_.size.x) +
                           static_cast<std::size_t>(area.low.x);
        for (std::size_t x = 0; x < width; ++x)
            std::memcpy(&row[step * x], &frame.rgba[source_channels * (first + x)], step);
        std::size_t best = 0;
        long smallest = 0;
        for (std::size_t kind = 0; kind < tries.size(); ++kind) {
            filter_row(static_cast<int>(kind), row, above, step, tries[kind]);
            const long found = weight(tries[kind]);
            if (kind == 0 || found < smallest) best = kind, smallest = found;
        }
        all.insert(all.end(), tries[best].begin(), tries[best].end());
        std::swap(row, above);
    }
    return all;
}

void ApngFile::write_pixels(const Image& frame, const Area& area) {
    std::vector<std::uint8_t> bytes = filtered(frame, area);
    const bool first = frames_ == 0;
    std::string data;
    Deflate().run(bytes, [&](std::string_view part) {
        data.clear();
        if (!first) put_32(data, sequence_++);
        data += part;
        chunk(first ? "IDAT" : "fdAT", data);
    });
}

/// The smallest rectangle that contains all changes from the last frame; one pixel if they are the same.
ApngFile::Area ApngFile::changed(const Image& frame) const {
    if (frames_ == 0) return {{0, 0}, format_.size};
    const auto width = static_cast<std::size_t>(format_.size.x);
    glm::ivec2 low = format_.size, high(-1);
    for (int y = 0; y < format_.size.y; ++y) {
        const std::size_t row = source_channels * width * static_cast<std::size_t>(y);
        const auto begin = frame.rgba.begin() + static_cast<std::ptrdiff_t>(row),
                   end = begin + static_cast<std::ptrdiff_t>(source_channels * width);
        const auto before = last_.rgba.begin() + static_cast<std::ptrdiff_t>(row);
        const auto first = std::mismatch(begin, end, before).first;
        if (first == end) continue;
        const auto last = std::mismatch(std::make_reverse_iterator(end), std::make_reverse_iterator(begin),
                                        std::make_reverse_iterator(before + (end - begin)))
                              .first;
        constexpr auto channels = static_cast<std::ptrdiff_t>(source_channels);
        low = {std::min(low.x, static_cast<int>((first - begin) / channels)), std::min(low.y, y)};
        high = {std::max(high.x, static_cast<int>((last.base() - begin - 1) / channels)), y};
    }
    if (high.y < 0) return {};
    return {low, high - low + 1};
}

void ApngFile::add(const Image& frame) {
    if (frame.size != format_.size)
        throw std::runtime_error("a frame of " + std::to_string(frame.size.x) + "x" +
                                 std::to_string(frame.size.y) + " pixels does not fit into a video of " +
                                 std::to_string(format_.size.x) + "x" + std::to_string(format_.size.y));
    if (frames_ == format_.frames)
        throw std::runtime_error("frame " + std::to_string(frames_ + 1) + " of " +
                                 std::to_string(format_.frames));
    const Area area = changed(frame);
    write_control(area);
    write_pixels(frame, area);
    last_ = frame;
    ++frames_;
}

void ApngFile::finish() {
    if (frames_ != format_.frames)
        throw std::runtime_error("only " + std::to_string(frames_) + " of " + std::to_string(format_.frames) +
                                 " frames");
    chunk("IEND", {});
}

}  // namespace tendril::app
