// The background gradient, and the grid on the ground.
#pragma once

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

}  // namespace tendril::app
