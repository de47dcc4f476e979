#include "app/labs/chain/colours.hpp"

#include <array>

namespace tendril::app {
namespace {

using Colours = std::array<glm::vec3, ik::all_methods.size()>;  // in the order of ik::Method

constexpr Colours on_dark{rgb(0xF2F5F8), rgb(0x3F8FE0), rgb(0xCC79A7), rgb(0xA9792B),
                          rgb(0x35C3A5), rgb(0xB9A6F2), rgb(0x8FA33B)};
constexpr Colours on_light{rgb(0x1E252E), rgb(0x1D6FC4), rgb(0xB2558A), rgb(0x8A5D10),
                           rgb(0x00886C), rgb(0x7A5FD0), rgb(0x66791A)};

}  // namespace

glm::vec3 pole_colour(const Palette& palette) {
    return palette.theme == Theme::Light ? rgb(0xB2558A) : rgb(0xCC79A7);
}

glm::vec3 solver_colour(const Palette& palette, ik::Method method) {
    return (palette.theme == Theme::Light ? on_light : on_dark)[static_cast<std::size_t>(method)];
}

}  // namespace tendril::app
