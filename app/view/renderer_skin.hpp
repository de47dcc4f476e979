// Skins, on the GPU: what is in SkinnedMesh is sent once and kept as long as somebody holds the mesh, the
// joints' matrices each frame. Solid ones are drawn with the other solids. Those that are seen through come
// after all solids of the scene: first their depth alone, then the surface that is nearest to the eye, once,
// over whatever is inside; so it has no inner walls, and no order of triangles shows.
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

    /// Draws those that are solid, or those that are not, into the bound framebuffer, the GL viewport being
    /// all of it. Returns the number of draw calls: one for each part of a mesh, two where it is seen
    /// through.
    int draw(const std::vector<SkinDraw>& skins, bool solid, const Camera& camera, const Frame& frame);

  private:
    class Sent;  // a mesh in GL's memory

    Sent& sent(const std::shared_ptr<const SkinnedMesh>& mesh);
    void send_matrices(const std::vector<AffineRows>& matrices);
    void forget_those_gone();

    Program program_{"skin.vert", "skin.frag"};
    GLuint matrices_ = 0, matrices_texture_ = 0, white_ = 0;
    std::size_t matrices_capacity_ = 0;  ///< bytes
    std::map<const SkinnedMesh*, std::unique_ptr<Sent>> sent_;
};

}  // namespace tendril::app
