// Finds objects in a picture by colour alone, as a viewer would, without knowing where they should be.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "app/io/image.hpp"

namespace tendril::test {

struct Blob {
    glm::vec2 centre{0.0f};  ///< of its bounding box, in pixels; a pixel's own centre is at +0.5
    int pixels = 0;
};

/// Connected regions of pixels of about that hue, saturated enough not to be blended. `solid` ignores lines:
/// counts only what remains after removing one pixel all round.
struct Wanted {
    glm::vec3 colour{0.0f};       ///< sRGB, 0 to 1
    float hue_off = 0.25f;        ///< radians
    float least_strength = 0.5f;  ///< relative to the saturation of `colour`
    bool solid = true;
};

/// The largest region within [low, high); nothing if there is none.
std::optional<Blob> find_blob(const app::Image& image, const Wanted& wanted, glm::ivec2 low, glm::ivec2 high);

}  // namespace tendril::test
