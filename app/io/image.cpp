#include "app/io/image.hpp"

#include <climits>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/io/json.hpp"
#include "app/system/atomic_file.hpp"

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
    const std::string png = read_text_file(path);
    try {
        return decode_png(png);
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot read " + path.string() + ": " + error.what());
    }
}

}  // namespace tendril::app
