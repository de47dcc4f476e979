#include "tests/app/golden/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tendril::test {
namespace {

using app::Image;

/// Part of a picture in CIELAB.
struct LabPicture {
    glm::ivec2 size{0};
    std::vector<glm::vec3> values;

    explicit LabPicture(glm::ivec2 s)
        : size(s), values(static_cast<std::size_t>(s.x) * static_cast<std::size_t>(s.y)) {}
    /// Clamps to the border.
    std::size_t index(int x, int y) const {
        x = std::clamp(x, 0, size.x - 1);
        y = std::clamp(y, 0, size.y - 1);
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x);
    }
    const glm::vec3& at(int x, int y) const { return values[index(x, y)]; }
    glm::vec3& at(int x, int y) { return values[index(x, y)]; }
};

struct Box {
    glm::ivec2 min{0}, max{0};  ///< exclusive
    glm::ivec2 size() const { return max - min; }
};

const std::uint8_t* pixel_of(const Image& image, int x, int y) {
    return image.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.x) +
                                    static_cast<std::size_t>(x));
}

/// Contains every byte that differs, with a margin for the neighbourhoods; empty if the pictures are equal.
Box changed_box(const Image& a, const Image& b) {
    constexpr int margin = 4;
    Box box{a.size, {0, 0}};
    for (int y = 0; y < a.size.y; ++y)
        for (int x = 0; x < a.size.x; ++x) {
            if (std::equal(pixel_of(a, x, y), pixel_of(a, x, y) + 3, pixel_of(b, x, y))) continue;
            box.min = glm::min(box.min, glm::ivec2(x, y));
            box.max = glm::max(box.max, glm::ivec2(x + 1, y + 1));
        }
    if (box.max.x == 0) return {};
    return {glm::max(box.min - margin, glm::ivec2(0)), glm::min(box.max + margin, a.size)};
}

/// 8-bit sRGB to linear light.
const std::array<float, 256>& linear_levels() {
    static const std::array<float, 256> levels = [] {
        std::array<float, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            const float v = static_cast<float>(i) / 255.0f;
            made[i] = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
        }
        return made;
    }();
    return levels;
}

float lab_curve(float t) {
    return t > 216.0f / 24389.0f ? std::cbrt(t) : (24389.0f / 27.0f * t + 16.0f) / 116.0f;
}

/// CIELAB for the white point of sRGB, D65.
glm::vec3 to_lab(const std::uint8_t* rgb) {
    const auto& levels = linear_levels();
    const float r = levels[rgb[0]], g = levels[rgb[1]], b = levels[rgb[2]];
    const float x = lab_curve((0.4124f * r + 0.3576f * g + 0.1805f * b) / 0.9505f);
    const float y = lab_curve(0.2126f * r + 0.7152f * g + 0.0722f * b);
    const float z = lab_curve((0.0193f * r + 0.1192f * g + 0.9505f * b) / 1.0891f);
    return {116.0f * y - 16.0f, 500.0f * (x - y), 200.0f * (y - z)};
}

LabPicture lab_of(const Image& image, const Box& box) {
    LabPicture lab(box.size());
    for (int y = 0; y < lab.size.y; ++y)
        for (int x = 0; x < lab.size.x; ++x)
            lab.at(x, y) = to_lab(pixel_of(image, box.min.x + x, box.min.y + y));
    return lab;
}

/// Distance of `value` from the range of values around (x, y).
float excess(glm::vec3 value, const LabPicture& other, int x, int y) {
    glm::vec3 low = other.at(x, y), high = low;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            low = glm::min(low, other.at(x + dx, y + dy));
            high = glm::max(high, other.at(x + dx, y + dy));
        }
    return glm::length(glm::max(glm::max(low - value, value - high), 0.0f));
}

/// The colour measure before its mean.
std::vector<float> excesses(const LabPicture& a, const LabPicture& b) {
    std::vector<float> result(a.values.size());
    for (int y = 0; y < a.size.y; ++y)
        for (int x = 0; x < a.size.x; ++x) {
            if (a.at(x, y) == b.at(x, y)) continue;
            result[a.index(x, y)] = std::max(excess(a.at(x, y), b, x, y), excess(b.at(x, y), a, x, y));
        }
    return result;
}

float mean3(const std::vector<float>& values, const LabPicture& shape, int x, int y) {
    float sum = 0.0f;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) sum += values[shape.index(x + dx, y + dy)];
    return sum / 9.0f;
}

template <std::size_t Count>
LabPicture blurred(const LabPicture& picture, const std::array<float, Count>& weights) {
    constexpr int half = static_cast<int>(Count) / 2;
    LabPicture rows(picture.size), result(picture.size);
    for (int y = 0; y < picture.size.y; ++y)
        for (int x = 0; x < picture.size.x; ++x)
            for (std::size_t i = 0; i < Count; ++i)
                rows.at(x, y) += weights[i] * picture.at(x + static_cast<int>(i) - half, y);
    for (int y = 0; y < picture.size.y; ++y)
        for (int x = 0; x < picture.size.x; ++x)
            for (std::size_t i = 0; i < Count; ++i)
                result.at(x, y) += weights[i] * rows.at(x, y + static_cast<int>(i) - half);
    return result;
}

constexpr std::array<float, 3> narrow{0.25f, 0.5f, 0.25f};
constexpr std::array<float, 5> wide{1.0f / 16, 4.0f / 16, 6.0f / 16, 4.0f / 16, 1.0f / 16};

LabPicture minus(LabPicture a, const LabPicture& b) {
    for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] -= b.values[i];
    return a;
}

void mark(Image& picture, int x, int y) {
    std::uint8_t* pixel = const_cast<std::uint8_t*>(pixel_of(picture, x, y));
    pixel[0] = 255, pixel[1] = 40, pixel[2] = 40;
}

Image dimmed(Image image) {
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 != 3) image.rgba[i] = static_cast<std::uint8_t>(image.rgba[i] / 3);
    }
    return image;
}

}  // namespace

std::string Difference::text() const {
    char line[160];
    std::snprintf(line, sizeof line,
                  "%d pixels differ, most at (%d, %d); colour up to %.2f, shape up to %.2f", pixels, worst.x,
                  worst.y, static_cast<double>(colour), static_cast<double>(shape));
    return line;
}

Difference compare(const Image& expected, const Image& actual, const Tolerance& tolerance) {
    Difference result;
    if (expected.size != actual.size || expected.rgba.size() != actual.rgba.size()) {
        result.same = false;
        result.pixels = std::max(actual.size.x * actual.size.y, 1);
        result.picture = actual;
        return result;
    }
    const Box box = changed_box(expected, actual);
    if (box.max.x == 0) return result;

    const LabPicture a = lab_of(expected, box), b = lab_of(actual, box);
    const std::vector<float> outside = excesses(blurred(a, narrow), blurred(b, narrow));
    const LabPicture apart = blurred(minus(a, b), wide);
    result.picture = dimmed(expected);
    float worst = 0.0f;
    for (int y = 0; y < a.size.y; ++y)
        for (int x = 0; x < a.size.x; ++x) {
            const float colour = mean3(outside, a, x, y), shape = glm::length(apart.at(x, y));
            result.colour = std::max(result.colour, colour);
            result.shape = std::max(result.shape, shape);
            const float share = std::max(colour / tolerance.colour, shape / tolerance.shape);
            if (share > worst) worst = share, result.worst = box.min + glm::ivec2(x, y);
            if (share <= 1.0f) continue;
            ++result.pixels;
            mark(result.picture, box.min.x + x, box.min.y + y);
        }
    result.same = result.pixels <= tolerance.max_pixels;
    return result;
}

}  // namespace tendril::test
