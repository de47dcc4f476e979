#include "app/view/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "app/window/offscreen_window.hpp"

namespace tendril::app {
namespace {

Image drawn(Renderer& renderer, const DrawScene& draw, const CameraPose& pose, glm::ivec2 size,
            const Palette& palette, bool grid, const DrawOver& over) {
    const OffscreenFramebuffer target(size);
    const std::vector<Pane> panes = draw(palette);
    renderer.draw(panes, pose, palette,
                  {.framebuffer = target.name(), .framebuffer_size = size, .grid = grid});
    if (over) {
        glBindFramebuffer(GL_FRAMEBUFFER, target.name());
        over(panes, palette);
    }
    return read_framebuffer(target.name(), size);
}

Palette before(Palette palette, float gray) {
    palette.background_top = palette.background_bottom = glm::vec3(gray);
    return palette;
}

/// Recovers opacity from the difference of two pictures: a colour c of opacity a over black is a c, over
/// white a c + 1 - a (A. R. Smith, J. F. Blinn, "Blue Screen Matting", SIGGRAPH 1996).
Image matted(const Image& black, const Image& white) {
    Image result{black.size, std::vector<std::uint8_t>(black.rgba.size())};
    for (std::size_t i = 0; i < result.rgba.size(); i += 4) {
        int through = 0;
        for (std::size_t c = 0; c < 3; ++c)
            through = std::max(through, static_cast<int>(white.rgba[i + c]) - black.rgba[i + c]);
        const int opacity = 255 - through;
        for (std::size_t c = 0; c < 3 && opacity > 0; ++c)
            result.rgba[i + c] =
                static_cast<std::uint8_t>(std::min(255L, std::lround(255.0 * black.rgba[i + c] / opacity)));
        result.rgba[i + 3] = static_cast<std::uint8_t>(opacity);
    }
    return result;
}

}  // namespace

Image read_framebuffer(unsigned framebuffer, glm::ivec2 size) {
    if (size.x < 1 || size.y < 1) throw std::runtime_error("a framebuffer without pixels can't be read");
    const auto rows = static_cast<std::size_t>(size.y), row = 4 * static_cast<std::size_t>(size.x);
    Image image{size, std::vector<std::uint8_t>(rows * row)};
    std::uint8_t* const pixels = image.rgba.data();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    for (std::size_t y = 0; y < rows / 2; ++y)  // GL's rows are from the bottom
        std::swap_ranges(pixels + y * row, pixels + (y + 1) * row, pixels + (rows - 1 - y) * row);
    for (std::size_t alpha = 3; alpha < rows * row; alpha += 4) pixels[alpha] = 255;
    return image;
}

Image draw_picture(Renderer& renderer, const DrawScene& draw, const CameraPose& pose, glm::ivec2 size,
                   const Palette& palette, Background background, const DrawOver& over) {
    if (background == Background::Scene) return drawn(renderer, draw, pose, size, palette, true, over);
    // Colours that fade into the background fade into white and black here.
    const Image white = drawn(renderer, draw, pose, size, before(palette, 1.0f), false, over);
    if (background == Background::White) return white;
    return matted(drawn(renderer, draw, pose, size, before(palette, 0.0f), false, over), white);
}

}  // namespace tendril::app
