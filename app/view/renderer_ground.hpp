// The ground: contact shadows of the strokes above it, and the grid.
//
// Shadows are collected in a picture of their own, smaller than the frame because they are soft, in which the
// darker one wins where two meet. Adding them up would turn a chain into a black worm. The grid's pass then
// lays both on the ground.
#pragma once

#include <vector>

#include "app/view/gl_objects.hpp"
#include "app/view/palette.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

/// Framebuffer pixels from the bottom left.
struct PixelRect {
    glm::ivec2 min{0}, size{0};
};

class GroundPass {
  public:
    GroundPass();
    ~GroundPass();
    GroundPass(const GroundPass&) = delete;
    GroundPass& operator=(const GroundPass&) = delete;

    /// Draws the shadows into their own picture; leaves that one bound. Returns the number of draw calls.
    int draw_shadows(const DrawList& list, const Camera& camera, float darkness, PixelRect viewport);
    /// Draws grid and shadows into the bound framebuffer.
    int draw_ground(const Camera& camera, const Palette& palette, const Frame& frame,
                    PixelRect viewport) const;

  private:
    struct Shadow {
        glm::vec4 ends;     ///< on the ground: a.x, a.z, b.x, b.z
        glm::vec4 heights;  ///< of the axis at a, at b; radius at a, at b
    };
    void collect(const DrawList& list, const Camera& camera);
    void allocate(glm::ivec2 size);

    Program shadow_program_, grid_program_;
    Instances buffer_, whole_;
    std::vector<Shadow> shadows_;
    GLuint framebuffer_ = 0, texture_ = 0;
    glm::ivec2 size_{0};
};

}  // namespace tendril::app
