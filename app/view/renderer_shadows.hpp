// Contact shadows on the ground.
//
// Shadows are drawn into a buffer of their own, smaller than the frame because they are soft, where the
// darker shadow wins: adding them would turn a chain's shadow solid black. That buffer is then drawn over the
// ground.
#pragma once

#include <vector>

#include "app/view/gl_objects.hpp"
#include "app/view/renderer_backdrop.hpp"

namespace tendril::app {

class ShadowPass {
  public:
    ShadowPass();
    ~ShadowPass();
    ShadowPass(const ShadowPass&) = delete;
    ShadowPass& operator=(const ShadowPass&) = delete;

    /// Draws the shadows' buffer; leaves it bound if there are shadows. Returns the number of draw calls.
    int prepare(const DrawList& list, const Camera& camera, float darkness, PixelRect viewport);
    /// Draws the shadows over the bound framebuffer, in the GL viewport, which must be the camera's.
    int draw(const Camera& camera) const;

  private:
    struct Shadow {
        glm::vec4 ends;     ///< projected on the ground: a.x, a.z, b.x, b.z
        glm::vec4 heights;  ///< of the axis at a, at b; then the radius at a, at b
        float darkest;      ///< 0 to 1; unused by the shader
    };
    void collect(const DrawList& list, const Camera& camera, float darkness);
    void add(const Stroke& stroke, const Camera& camera, float darkness);
    void drop_faint();
    void allocate(glm::ivec2 size);

    Program program_{"shadow.vert", "shadow.frag"};
    Program over_program_{"shadow_over.vert", "shadow_over.frag"};
    Instances buffer_, whole_{0, {}};
    std::vector<Shadow> shadows_;
    Rect bounds_;        ///< bounds of all shadows, in window pixels
    float area_ = 0.0f;  ///< area of all shadows, in window pixels
    GLuint framebuffer_ = 0, texture_ = 0;
    glm::ivec2 size_{0};
};

}  // namespace tendril::app
