#include "app/io/image.hpp"

#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/document/atomic_file.hpp"
#include "app/system/file.hpp"
#include "app/window/gl.hpp"

// Static, since some systems' Dear ImGui includes a whole stb library with the same names.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_MAX_DIMENSIONS 32768
#include <stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace tendril::app {
namespace {

constexpr int channels = 4;

std::size_t byte_count(glm::ivec2 size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * channels;
}

}  // namespace

Image read_framebuffer(unsigned framebuffer, glm::ivec2 size) {
    if (size.x < 1 || size.y < 1) throw std::runtime_error("a framebuffer without pixels can't be read");
    std::vector<std::uint8_t> upside_down(byte_count(size));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.data());

    Image image{size, std::vector<std::uint8_t>(upside_down.size())};
    const std::size_t row = byte_count({size.x, 1});
    for (std::size_t y = 0; y < static_cast<std::size_t>(size.y); ++y) {
        const std::uint8_t* const from =
            upside_down.data() + (static_cast<std::size_t>(size.y) - 1 - y) * row;
        std::uint8_t* const to = image.rgba.data() + y * row;
        for (std::size_t x = 0; x < row; ++x) to[x] = x % channels == 3 ? std::uint8_t{255} : from[x];
    }
    return image;
}

std::string encode_png(const Image& image) {
    const bool complete = image.size.x > 0 && image.size.y > 0 && image.rgba.size() == byte_count(image.size);
    if (!complete) throw std::runtime_error("the picture has no pixels");
    std::string png;
    const auto append = [](void* out, void* data, int count) {
        static_cast<std::string*>(out)->append(static_cast<const char*>(data),
                                               static_cast<std::size_t>(count));
    };
    if (stbi_write_png_to_func(append, &png, image.size.x, image.size.y, channels, image.rgba.data(),
                               image.size.x * channels) == 0)
        throw std::runtime_error("out of memory");
    return png;
}

Image decode_png(std::string_view png) {
    Image image;
    int found = 0;
    if (png.size() > INT_MAX) throw std::runtime_error("the picture is too large");
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()), static_cast<int>(png.size()),
                              &image.size.x, &image.size.y, &found, channels),
        &stbi_image_free);
    if (!pixels) throw std::runtime_error(stbi_failure_reason());
    image.rgba.assign(pixels.get(), pixels.get() + byte_count(image.size));
    return image;
}

void write_png(const std::filesystem::path& path, const Image& image) {
    std::string png;
    try {
        png = encode_png(image);
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot write " + path.string() + ": " + error.what());
    }
    write_file_atomically(path, png);
}

Image read_png(const std::filesystem::path& path) {
    Image image;
    int found = 0;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(open_to_read(path), &std::fclose);
    if (!file)
        throw std::runtime_error("cannot read " + path.string() + ": " +
                                 std::generic_category().message(errno));
    stbi_uc* const pixels = stbi_load_from_file(file.get(), &image.size.x, &image.size.y, &found, channels);
    if (pixels == nullptr)
        throw std::runtime_error("cannot read " + path.string() + ": " + stbi_failure_reason());
    try {
        image.rgba.assign(pixels, pixels + byte_count(image.size));
    } catch (...) {
        stbi_image_free(pixels);
        throw;
    }
    stbi_image_free(pixels);
    return image;
}

}  // namespace tendril::app
