// Pictures in memory and as PNG files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::app {

/// 8-bit RGBA, rows from the top.
struct Image {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgba;
};

/// Throws std::runtime_error naming the path and the reason. Writing is atomic.
void write_png(const std::filesystem::path& path, const Image& image);
Image read_png(const std::filesystem::path& path);

/// A PNG file's bytes. Throws std::runtime_error with the reason.
std::string encode_png(const Image& image);
Image decode_png(std::string_view png);

}  // namespace tendril::app
