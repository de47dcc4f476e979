// Draws a DrawList with GL 3.3 core: background, ground grid, contact shadows, meshes, skins, strokes. Takes
// one draw call for the background, at most eight per pane, however long the list, and one or two per
// material of a skin. Edges are anti-aliased by coverage, without multisampling, so that a software
// rasteriser is fast and every backend gives the same picture. (The line where two solids intersect is not
// anti-aliased.)
//
// Cost on two CPU cores without a graphics card at 1280 x 720: 20 000 strokes about 20 ms; the background
// about 5 ms, and next to nothing while the camera is still.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <span>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/palette.hpp"
#include "app/view/panes.hpp"

namespace tendril::app {

struct Frame {
    unsigned framebuffer = 0;
    glm::ivec2 framebuffer_size{0};  ///< pixels
    float pixel_ratio = 1.0f;        ///< framebuffer pixels per window coordinate
    bool grid = true;
    bool dither = true;  ///< hides banding in the background; without it a PNG is a third of the size
};

class Renderer {
  public:
    /// Needs a current context. Throws std::runtime_error with the driver's log if a shader fails.
    Renderer();
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Clears the whole framebuffer to the palette and draws the list in the camera's viewport.
    void draw(const DrawList& list, const Camera& camera, const Palette& palette, const Frame& frame);
    /// The same with several panes, each in its rectangle with the same camera pose.
    void draw(std::span<const Pane> panes, const CameraPose& pose, const Palette& palette,
              const Frame& frame);
    /// GL draw calls that the last draw() made.
    int draw_calls() const;

  private:
    void draw_scene(const DrawList& list, const Camera& camera, const Palette& palette, const Frame& frame);

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace tendril::app
