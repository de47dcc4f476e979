// The mesh of a DrawList, in one draw call.
#pragma once

#include "app/view/gl_objects.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

/// For programs whose vertex shader includes surface.glsl and whose fragment shader includes light.glsl.
void set_surface_uniforms(const Program& program, const Camera& camera, const Frame& frame);

class MeshPass {
  public:
    /// Draws into the bound framebuffer; the GL viewport must be all of it. Returns the number of draw calls:
    /// 0 for an empty mesh, else 1. With an opacity below 1, it does not write depth and so hides nothing.
    int draw(const Mesh& mesh, const Camera& camera, const Frame& frame, float opacity = 1.0f);

  private:
    Program program_{"mesh.vert", "mesh.frag"};
    Triangles triangles_;
};

}  // namespace tendril::app
