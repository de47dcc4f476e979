#include "tests/app/support/blobs.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tendril::test {
namespace {

/// The colour without its grey: the direction is the hue, the length the saturation.
glm::vec2 hue_of(glm::vec3 rgb) {
    return {rgb.r - 0.5f * (rgb.g + rgb.b), 0.8660254f * (rgb.g - rgb.b)};
}

class Mask {
  public:
    Mask(glm::ivec2 low, glm::ivec2 high) : low_(low), size_(high - low), set_(count()) {}
    bool at(int x, int y) const { return inside(x, y) && set_[index(x, y)] != 0; }
    void set(int x, int y, bool to) { set_[index(x, y)] = to ? 1 : 0; }
    glm::ivec2 low() const { return low_; }
    glm::ivec2 high() const { return low_ + size_; }

    /// Removes one pixel all round.
    Mask eroded() const {
        Mask result(low(), high());
        for (int y = low().y; y < high().y; ++y)
            for (int x = low().x; x < high().x; ++x) {
                bool all = true;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) all = all && at(x + dx, y + dy);
                result.set(x, y, all);
            }
        return result;
    }

  private:
    std::size_t count() const {
        return static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y);
    }
    bool inside(int x, int y) const { return x >= low_.x && y >= low_.y && x < high().x && y < high().y; }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - low_.y) * static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(x - low_.x);
    }
    glm::ivec2 low_, size_;
    std::vector<char> set_;
};

Mask mask_of(const app::Image& image, const Wanted& wanted, glm::ivec2 low, glm::ivec2 high) {
    const glm::vec2 hue = hue_of(wanted.colour);
    const float strength = glm::length(hue);
    Mask mask(low, high);
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) {
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.x) +
                                       static_cast<std::size_t>(x));
            const glm::vec2 found =
                hue_of(glm::vec3(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]) / 255.0f);
            const float length = glm::length(found);
            const bool strong = length >= wanted.least_strength * strength;
            mask.set(x, y, strong && glm::dot(found, hue) >= std::cos(wanted.hue_off) * length * strength);
        }
    return mask;
}

/// Clears the region that contains (x, y) and returns it.
Blob take_region(Mask& mask, int x, int y) {
    std::vector<glm::ivec2> open{{x, y}};
    glm::ivec2 least{x, y}, most{x, y};
    mask.set(x, y, false);
    Blob blob;
    while (!open.empty()) {
        const glm::ivec2 at = open.back();
        open.pop_back();
        ++blob.pixels;
        least = glm::min(least, at);
        most = glm::max(most, at);
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                if (!mask.at(at.x + dx, at.y + dy)) continue;
                mask.set(at.x + dx, at.y + dy, false);
                open.push_back(at + glm::ivec2(dx, dy));
            }
    }
    blob.centre = 0.5f * (glm::vec2(least) + glm::vec2(most + 1));
    return blob;
}

}  // namespace

std::optional<Blob> find_blob(const app::Image& image, const Wanted& wanted, glm::ivec2 low,
                              glm::ivec2 high) {
    Mask mask = mask_of(image, wanted, low, high);
    if (wanted.solid) mask = mask.eroded().eroded();
    std::optional<Blob> largest;
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) {
            if (!mask.at(x, y)) continue;
            const Blob blob = take_region(mask, x, y);
            if (!largest || blob.pixels > largest->pixels) largest = blob;
        }
    return largest;
}

}  // namespace tendril::test
