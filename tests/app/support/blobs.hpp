// Finds things in a picture by their colour, as a person would: knowing nothing of where they should be.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "app/io/image.hpp"

namespace tendril::test {

struct Blob {
    glm::vec2 centre{0.0f};  ///< of the box around it, in pixels; a pixel's own centre is at +0.5
    int pixels = 0;
};

/// Pixels of about that hue, strong enough to be no blend with something else, as connected regions. Nothing
/// where there are none. `solid` leaves out lines: only what stays after a pixel is taken off all round
/// counts.
struct Wanted {
    glm::vec3 colour{0.0f};       ///< sRGB, 0 to 1
    float hue_off = 0.25f;        ///< radians
    float least_strength = 0.5f;  ///< share of the wanted colour's own saturation
    bool solid = true;
};

/// The largest region within [low, high).
std::optional<Blob> find_blob(const app::Image& image, const Wanted& wanted, glm::ivec2 low, glm::ivec2 high);

}  // namespace tendril::test
