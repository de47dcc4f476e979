#include "app/view/renderer_mesh.hpp"

namespace tendril::app {

// Positions and depths must match StrokeProjector's and StrokePass's, or edges would not lie on their
// surfaces.
void set_surface_uniforms(const Program& program, const Camera& camera, const Frame& frame) {
    const glm::mat4& p = camera.projection();
    const glm::vec3 right = camera.right(), up = camera.up(), forward = camera.forward();
    const bool orthographic = camera.pose().orthographic;
    const glm::vec3 target = camera.pose().target;
    program.set("eye", camera.eye());
    program.set(
        "to_eye_space",
        glm::mat4(glm::vec4(right.x, up.x, forward.x, 0.0f), glm::vec4(right.y, up.y, forward.y, 0.0f),
                  glm::vec4(right.z, up.z, forward.z, 0.0f), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)));
    program.set("orthographic", orthographic ? 1.0f : 0.0f);
    // Window pixels per metre, at a depth of 1 m (orthographic: everywhere); then pixels to -1 to 1 of the
    // framebuffer.
    const float pixels = (orthographic ? 1.0f : camera.depth(target)) / camera.metres_per_pixel(target);
    const glm::vec2 unit = 2.0f * frame.pixel_ratio / glm::vec2(frame.framebuffer_size);
    const glm::vec2 centre = camera.viewport().centre() * unit;
    program.set("scale", pixels * unit);
    program.set("shift", glm::vec2(centre.x - 1.0f, 1.0f - centre.y));
    program.set("to_clip_depth", glm::vec2(-p[2][2], p[3][2]));
    program.set("sky", glm::vec3(right.y, up.y, -forward.y));
}

int MeshPass::draw(const Mesh& mesh, const Camera& camera, const Frame& frame, float opacity) {
    if (mesh.indices.empty()) return 0;
    program_.use();
    set_surface_uniforms(program_, camera, frame);
    program_.set("opacity", opacity);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(opacity < 1.0f ? GL_FALSE : GL_TRUE);
    glDepthFunc(GL_LEQUAL);
    if (opacity < 1.0f)
        glEnable(GL_BLEND);
    else
        glDisable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    triangles_.send(mesh.vertices, mesh.indices);
    triangles_.draw();
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    return 1;
}

}  // namespace tendril::app
