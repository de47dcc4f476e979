// Animated PNG, which browsers and image viewers play: Portable Network Graphics (PNG) Specification, third
// edition, W3C 2025, https://www.w3.org/TR/png-3/: chunks acTL, fcTL and fdAT. Lossless, with an alpha
// channel. After the first frame, only the changed rectangle is written. Memory: two frames, and the filtered
// bytes of one rectangle.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "app/io/video_file.hpp"

namespace tendril::app {

/// Loops forever. Viewers without animation support show the first frame.
class ApngFile final : public VideoFile {
  public:
    ApngFile(const std::filesystem::path& path, const VideoFormat& format);
    void add(const Image& frame) override;
    void finish() override;

  private:
    /// A part of the picture, at least one pixel.
    struct Area {
        glm::ivec2 low{0}, size{1};
    };
    Area changed(const Image& frame) const;
    void chunk(const char* type, std::string_view data);
    void write_head();
    void write_control(const Area& area);
    void write_pixels(const Image& frame, const Area& area);
    /// The frame's part in PNG format: each row begins with its filter type.
    std::vector<std::uint8_t> filtered(const Image& frame, const Area& area) const;

    VideoFormat format_;
    Image last_;  ///< the last frame added
    int frames_ = 0;
    std::uint32_t sequence_ = 0;  ///< number of fcTL and fdAT chunks
};

}  // namespace tendril::app
