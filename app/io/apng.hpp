// Animated PNG, which browsers and image viewers play: Portable Network Graphics (PNG) Specification, third
// edition, W3C 2025, https://www.w3.org/TR/png-3/: chunks acTL, fcTL and fdAT. It loses nothing and has an
// alpha channel. Of each frame after the first, only the rectangle that changed is written. In memory are two
// frames at a time, and the changed part of one, filtered.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "app/document/atomic_file.hpp"
#include "app/io/video_file.hpp"

namespace tendril::app {

/// Plays again and again. A viewer that knows no animation shows the first frame.
class ApngFile final : public VideoFile {
  public:
    ApngFile(const std::filesystem::path& path, const VideoFormat& format);
    void add(const Image& frame) override;
    void finish() override;

  private:
    /// A part of the picture; never empty.
    struct Area {
        glm::ivec2 low{0}, size{1};
    };
    Area changed(const Image& frame) const;
    void chunk(const char* type, std::string_view data);
    void write_head();
    void write_control(const Area& area);
    void write_pixels(const Image& frame, const Area& area);
    /// The frame's part as PNG has it: each row after the number of its filter.
    std::vector<std::uint8_t> filtered(const Image& frame, const Area& area) const;

    AtomicFile file_;
    VideoFormat format_;
    Image last_;  ///< the frame that was added before
    int frames_ = 0;
    std::uint32_t sequence_ = 0;  ///< counts fcTL and fdAT
};

}  // namespace tendril::app
