#include "app/view/palette.hpp"

namespace tendril::app {
namespace {

constexpr glm::vec3 rgb(unsigned hex) {
    return glm::vec3(static_cast<float>((hex >> 16) & 255u), static_cast<float>((hex >> 8) & 255u),
                     static_cast<float>(hex & 255u)) /
           255.0f;
}

const Palette dark{
    .target = rgb(0xE69F00),
    .head = rgb(0x56B4E9),
    .tail = rgb(0x009E73),
    .selection = rgb(0xF0E442),
    .limit = rgb(0xD55E00),
    .ghost = rgb(0x6F7886),
    .joint = rgb(0xD3DAE3),
    .link = rgb(0x8C99A8),
    .axis_x = rgb(0xC25B5B),
    .axis_y = rgb(0x6FA36B),
    .axis_z = rgb(0x5B82C2),
    .background_top = rgb(0x1B2028),
    .background_bottom = rgb(0x0E1116),
    .grid = rgb(0x4A5666),
    .shadow = 0.62f,
    .bar = rgb(0x12161C),
    .panel = rgb(0x1B2129),
    .field = rgb(0x272F3A),
    .border = rgb(0x323C49),
    .text = rgb(0xDDE3EA),
    .text_dim = rgb(0x8E9AA8),
    .accent = rgb(0x4FA3C7),
};

// The same hues, darker where they would drown on white; yellow most of all.
const Palette light{
    .target = rgb(0xD98A00),
    .head = rgb(0x2C8FCB),
    .tail = rgb(0x008A64),
    .selection = rgb(0xC9B400),
    .limit = rgb(0xC65200),
    .ghost = rgb(0x9AA3AE),
    .joint = rgb(0x4A5563),
    .link = rgb(0x7C8896),
    .axis_x = rgb(0xC04848),
    .axis_y = rgb(0x4D8A48),
    .axis_z = rgb(0x4570B8),
    .background_top = rgb(0xF2F4F7),
    .background_bottom = rgb(0xD5DAE1),
    .grid = rgb(0x98A3B0),
    .shadow = 0.34f,
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

}  // namespace tendril::app
