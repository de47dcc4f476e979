// Static, since some systems' Dear ImGui includes a whole stb library with the same names.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#include <stb_image.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "app/io/character/skin.hpp"

namespace tendril::app {
namespace {

constexpr int longest_side = 2048;
constexpr std::size_t max_pixels = std::size_t{1} << 26;  // limit for one picture before it is halved: 256 MB
/// A byte of a PNG expands to at most 1032 bytes of rows (zlib, RFC 1951) of eight pixels each; JPEG to less.
constexpr std::size_t max_pixels_of_byte = 8 * 1032;

std::size_t pixels(const glm::ivec2& size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

/// True if a PNG has the bytes that its chunks claim: stb allocates them before it checks. Other files pass.
bool has_its_chunks(std::string_view bytes) {
    if (!bytes.starts_with("\x89PNG")) return true;
    std::size_t at = 8;
    while (at + 8 <= bytes.size()) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
        if (length > bytes.size() - at - 8) return false;
        at += 8 + length + 4;
    }
    return true;
}

/// Each pixel is the mean of four.
Picture halved(const Picture& whole) {
    Picture half;
    half.size = {std::max(whole.size.x / 2, 1), std::max(whole.size.y / 2, 1)};
    half.rgba.resize(4 * static_cast<std::size_t>(half.size.x) * static_cast<std::size_t>(half.size.y));
    for (int y = 0; y < half.size.y; ++y)
        for (int x = 0; x < half.size.x; ++x)
            for (int c = 0; c < 4; ++c) {
                int sum = 2;
                for (int k = 0; k < 4; ++k) {
                    const int from_x = std::min(2 * x + (k & 1), whole.size.x - 1);
                    const int from_y = std::min(2 * y + (k >> 1), whole.size.y - 1);
                    sum += whole.rgba[static_cast<std::size_t>(4 * (from_y * whole.size.x + from_x) + c)];
                }
                half.rgba[static_cast<std::size_t>(4 * (y * half.size.x + x) + c)] =
                    static_cast<std::uint8_t>(sum / 4);
            }
    return half;
}

}  // namespace

std::int32_t SkinBuilder::add_picture(std::string_view bytes) {
    if (const auto known = known_.find(bytes); known != known_.end()) return known->second;
    int channels = 0;
    Picture picture;
    const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int length = static_cast<int>(std::min<std::size_t>(bytes.size(), 1u << 30));
    if (!has_its_chunks(bytes) ||
        !stbi_info_from_memory(data, length, &picture.size.x, &picture.size.y, &channels) ||
        picture.size.x <= 0 || picture.size.y <= 0 ||
        pixels(picture.size) > std::min(max_pixels, max_pixels_of_byte * bytes.size()))
        return -1;
    // Count the bytes too, since they are kept to recognise a picture.
    decoded_ += pixels(picture.size) + bytes.size();
    full_ = full_ || decoded_ > 4 * max_pixels_ || kept_ >= max_pixels_;
    if (full_) return -1;
    const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
        stbi_load_from_memory(data, length, &picture.size.x, &picture.size.y, &channels, 4),
        &stbi_image_free);
    if (!decoded) return -1;
    picture.rgba.assign(decoded.get(), decoded.get() + 4 * pixels(picture.size));
    const std::size_t most = std::max<std::size_t>((max_pixels_ - kept_) / 8, 1);
    while (std::max(picture.size.x, picture.size.y) > longest_side || pixels(picture.size) > most)
        picture = halved(picture);
    kept_ += pixels(picture.size);
    mesh_.pictures.push_back(std::move(picture));
    const auto index = static_cast<std::int32_t>(mesh_.pictures.size()) - 1;
    known_.emplace(bytes, index);
    return index;
}

}  // namespace tendril::app
