// The mesh of a DrawList, in one draw call.
#pragma once

#include "app/view/gl_objects.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

class MeshPass {
  public:
    /// Draws into the bound framebuffer, the GL viewport being all of it. Returns the number of draw calls:
    /// none where there are no triangles, else one.
    int draw(const Mesh& mesh, const Camera& camera, const Frame& frame);

  private:
    void set_uniforms(const Camera& camera, const Frame& frame) const;

    Program program_{"mesh.vert", "mesh.frag"};
    Triangles triangles_;
};

}  // namespace tendril::app
