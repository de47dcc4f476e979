// Static, since some systems' Dear ImGui includes a whole stb library with the same names.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#include <stb_image.h>

#include <algorithm>
#include <memory>

#include "app/io/character/skin.hpp"

namespace tendril::app {
namespace {

constexpr int longest_side = 2048;
constexpr int max_pixels = 1 << 26;  // 256 MB

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

std::int32_t SkinBuilder::add_picture(const unsigned char* bytes, std::size_t size) {
    int x = 0, y = 0, channels = 0;
    const int length = static_cast<int>(std::min<std::size_t>(size, 1u << 30));
    if (!stbi_info_from_memory(bytes, length, &x, &y, &channels) || x <= 0 || y <= 0 || x > max_pixels / y)
        return -1;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes, length, &x, &y, &channels, 4), &stbi_image_free);
    if (!pixels) return -1;
    Picture picture;
    picture.size = {x, y};
    picture.rgba.assign(pixels.get(),
                        pixels.get() + 4 * static_cast<std::size_t>(x) * static_cast<std::size_t>(y));
    while (std::max(picture.size.x, picture.size.y) > longest_side) picture = halved(picture);
    mesh_.pictures.push_back(std::move(picture));
    return static_cast<std::int32_t>(mesh_.pictures.size()) - 1;
}

}  // namespace tendril::app
