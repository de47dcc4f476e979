// The mesh of a DrawList, in one draw call.
#pragma once

#include "app/view/gl_objects.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

/// Of a program whose vertex shader includes surface.glsl, and whose fragment shader light.glsl.
void set_surface_uniforms(const Program& program, const Camera& camera, const Frame& frame);

class MeshPass {
  public:
    /// Draws into the bound framebuffer, the GL viewport being all of it. Returns the number of draw calls:
    /// none where there are no triangles, else one. Below an opacity of 1 nothing is hidden by what is drawn.
    int draw(const Mesh& mesh, const Camera& camera, const Frame& frame, float opacity = 1.0f);

  private:
    Program program_{"mesh.vert", "mesh.frag"};
    Triangles triangles_;
};

}  // namespace tendril::app
