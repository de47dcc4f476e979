// What lies behind all strokes, the gradient and the grid, kept while the camera stands still.
//
// On a software rasteriser these two take longer than anything else in a small scene, and while one drags a
// chain or watches a rope swing they stay as they are. So once a second frame asks for the same backdrop it
// is drawn into a picture of its own, and from then on copied from there. Copying gives the same bits as
// drawing.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "app/view/gl_objects.hpp"
#include "app/view/renderer_grid.hpp"

namespace tendril::app {

/// Framebuffer pixels from the bottom left.
struct PixelRect {
    glm::ivec2 min{0}, size{0};
};

/// A viewport in framebuffer pixels, within the framebuffer.
PixelRect pixel_rect(const Rect& viewport, const Frame& frame);

class Backdrop {
  public:
    Backdrop();
    ~Backdrop();
    Backdrop(const Backdrop&) = delete;
    Backdrop& operator=(const Backdrop&) = delete;

    /// Fills frame.framebuffer, and leaves it bound; the grid is in each of the viewports. Returns the number
    /// of draw calls; a copy counts as one for each that it saves, so that the number tells of the picture
    /// and not of the frame before.
    int draw(const CameraPose& pose, std::span<const Rect> viewports, const Palette& palette,
             const Frame& frame);

  private:
    /// All that the backdrop depends on.
    struct Key {
        CameraPose pose;
        std::vector<Rect> viewports;
        std::array<glm::vec3, 6> colours;
        glm::ivec2 size;
        float pixel_ratio;
        bool grid, dither;
        bool operator==(const Key&) const = default;
    };
    int draw_directly(const Key& key, const Palette& palette, const Frame& frame) const;
    void keep(const Key& key, const Palette& palette, const Frame& frame);

    BackgroundPass background_;
    GridPass grid_;
    GLuint framebuffer_ = 0, colour_ = 0;
    glm::ivec2 size_{0};
    std::optional<Key> last_, kept_;
    int kept_calls_ = 0;  ///< that drawing it took
};

}  // namespace tendril::app
