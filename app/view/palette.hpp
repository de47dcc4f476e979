// The colours of the picture, named by meaning. The meanings are the same in all labs and both themes; the
// hues are from Okabe and Ito (2008), which colour-blind people can distinguish.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "app/document/settings.hpp"

namespace tendril::app {

/// sRGB, 0 to 1. Colours that only one lab uses are defined in that lab's folder.
struct Palette {
    Theme theme;
    // objects with a meaning
    glm::vec3 target, head, tail, selection, limit, ghost;
    // ordinary joints and the links between them
    glm::vec3 joint, neutral;
    // axes
    glm::vec3 axis_x, axis_y, axis_z;
    // the surroundings
    glm::vec3 background_top, background_bottom, grid;
    float shadow = 0.5f;  ///< darkness of a contact shadow, 0 to 1
    // the panels
    glm::vec3 bar, panel, field, border, text, text_dim, accent;
};

const Palette& palette(Theme theme);

/// From hexadecimal notation: 0xE69F00.
constexpr glm::vec3 rgb(unsigned hex) {
    return glm::vec3(static_cast<float>((hex >> 16) & 255u), static_cast<float>((hex >> 8) & 255u),
                     static_cast<float>(hex & 255u)) /
           255.0f;
}

/// Blends a colour towards the background (strength 1: the full colour). Opaque, so that strokes that meet
/// show no seam.
glm::vec4 faded(const Palette& palette, glm::vec3 colour, float strength);

}  // namespace tendril::app
