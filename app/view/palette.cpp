#include "app/view/palette.hpp"

namespace tendril::app {
namespace {

const Palette dark{
    .theme = Theme::Dark,
    .target = rgb(0xE69F00),
    .head = rgb(0x56B4E9),
    .tail = rgb(0x009E73),
    .selection = rgb(0xF0E442),
    .limit = rgb(0xD55E00),
    .ghost = rgb(0x6F7886),
    .joint = rgb(0xD3DAE3),
    .neutral = rgb(0x8C99A8),
    .axis_x = rgb(0xC25B5B),
    .axis_y = rgb(0x6FA36B),
    .axis_z = rgb(0x5B82C2),
    .background_top = rgb(0x1E242D),
    .background_bottom = rgb(0x14181E),
    .grid = rgb(0x4E5B6C),
    .shadow = 0.70f,
    .bar = rgb(0x1A1F26),
    .panel = rgb(0x222932),
    .field = rgb(0x2E3743),
    .border = rgb(0x3A4553),
    .text = rgb(0xDDE3EA),
    .text_dim = rgb(0x8E9AA8),
    .accent = rgb(0x4FA3C7),
};

// The same hues, darker where they would be too faint on white, yellow most of all.
const Palette light{
    .theme = Theme::Light,
    .target = rgb(0xDE9200),
    .head = rgb(0x2C8FCB),
    .tail = rgb(0x008A64),
    .selection = rgb(0xC9B400),
    .limit = rgb(0xC65200),
    .ghost = rgb(0x9AA3AE),
    .joint = rgb(0x5A6675),
    .neutral = rgb(0x8793A1),
    .axis_x = rgb(0xC04848),
    .axis_y = rgb(0x4D8A48),
    .axis_z = rgb(0x4570B8),
    .background_top = rgb(0xF2F4F7),
    .background_bottom = rgb(0xD5DAE1),
    .grid = rgb(0x98A3B0),
    .shadow = 0.36f,
    .bar = rgb(0xE4E8ED),
    .panel = rgb(0xF0F2F5),
    .field = rgb(0xFFFFFF),
    .border = rgb(0xC5CCD5),
    .text = rgb(0x1E252E),
    .text_dim = rgb(0x5E6A78),
    .accent = rgb(0x1B7FA6),
};

}  // namespace

const Palette& palette(Theme theme) {
    return theme == Theme::Light ? light : dark;
}

glm::vec4 faded(const Palette& palette, glm::vec3 colour, float strength) {
    const glm::vec3 ground = 0.5f * (palette.background_top + palette.background_bottom);
    return glm::vec4(ground + strength * (colour - ground), 1.0f);
}

}  // namespace tendril::app
