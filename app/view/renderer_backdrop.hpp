// The background gradient and the grid on the ground, behind all strokes, cached while the camera is still.
//
// On a software rasteriser these two take longer than the rest of a small scene, and do not change while the
// user drags a chain or watches a rope swing. They are drawn into a buffer, and copied from there into every
// frame: drawing into frames of another format could round differently.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "app/view/gl_objects.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

class BackgroundPass {
  public:
    /// Covers the whole framebuffer. Like all passes, returns the number of draw calls.
    int draw(const Palette& palette, const Frame& frame) const;

  private:
    Program program_{"background.vert", "background.frag"};
    Instances whole_{0, {}};
};

class GridPass {
  public:
    /// Draws into the camera's viewport, which is the GL viewport. Ignores depth: objects below the ground
    /// show through it.
    int draw(const Camera& camera, const Palette& palette, const Frame& frame) const;

  private:
    Program program_{"grid.vert", "grid.frag"};
    Instances whole_{0, {}};
};

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

    /// Fills frame.framebuffer and leaves it bound; draws the grid in each viewport. Returns the number of
    /// draw calls; a cached copy counts as the calls it replaces, so the number is the same every frame.
    int draw(const CameraPose& pose, std::span<const Rect> viewports, const Palette& palette,
             const Frame& frame);

  private:
    /// Everything the backdrop depends on.
    struct Key {
        CameraPose pose;
        std::vector<Rect> viewports;
        std::array<glm::vec3, 6> colours;
        glm::ivec2 size;
        float pixel_ratio;
        bool grid, dither;
        bool operator==(const Key&) const = default;
    };
    int draw_into_cache(const Key& key, const Palette& palette, const Frame& frame) const;
    void cache(const Key& key, const Palette& palette, const Frame& frame);

    BackgroundPass background_;
    GridPass grid_;
    GLuint framebuffer_ = 0, colour_ = 0;
    glm::ivec2 size_{0};
    std::optional<Key> cached_;
    int cached_calls_ = 0;  ///< the draw calls of the cached backdrop
};

}  // namespace tendril::app
