// Solids on the GPU: skins, and the mesh of a DrawList. A SkinnedMesh is sent once and kept as long as the
// mesh lives; the joints' matrices are sent each frame. Solid skins are drawn with the other solids.
// Transparent ones follow after all solids of the scene: first depth alone, then only the nearest surface,
// blended over the picture so far, so that neither inner walls nor the order of triangles show.
#pragma once

#include <map>
#include <memory>

#include "app/view/gl_objects.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

class SkinPass {
  public:
    SkinPass();
    ~SkinPass();
    SkinPass(const SkinPass&) = delete;
    SkinPass& operator=(const SkinPass&) = delete;

    /// Draws the solid skins, or the transparent ones, into the bound framebuffer; the GL viewport must be
    /// all of it. Returns the number of draw calls: one for each part of a mesh, two if it is transparent.
    int draw(const std::vector<SkinDraw>& skins, bool solid, const Camera& camera, const Frame& frame);

  private:
    class Sent;  // a mesh in GPU memory

    Sent& sent(const std::shared_ptr<const SkinnedMesh>& mesh);
    void send_matrices(const std::vector<AffineRows>& matrices);
    void erase_expired();

    Program program_{"skin.vert", "skin.frag"};
    GLuint matrices_ = 0, white_ = 0;
    std::map<const SkinnedMesh*, std::unique_ptr<Sent>> sent_;
};

// The mesh of a DrawList, in one draw call.

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
