#include "app/view/renderer.hpp"

#include "app/view/renderer_backdrop.hpp"
#include "app/view/renderer_shadows.hpp"
#include "app/view/renderer_skin.hpp"
#include "app/view/renderer_strokes.hpp"

namespace tendril::app {

struct Renderer::Impl {
    Backdrop backdrop;
    ShadowPass shadows;
    MeshPass mesh;
    SkinPass skins;
    StrokePass strokes;
    int draw_calls = 0;
};

namespace {

constexpr float veil_opacity = 0.13f;  ///< opacity of one layer; a hollow body has two

/// Resets state that earlier drawing, such as the panels', may have changed.
void reset_state() {
    glDisable(GL_CULL_FACE);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    reset_desktop_state();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glActiveTexture(GL_TEXTURE0);
    glBindSampler(0, 0);
}

/// The panels' backend saves and restores the state it finds; leave it a plain one.
void leave_plain_state() {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glUseProgram(0);
}

}  // namespace

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;

void Renderer::draw(const DrawList& list, const Camera& camera, const Palette& palette, const Frame& frame) {
    reset_state();
    impl_->draw_calls = impl_->backdrop.draw(camera.pose(), {&camera.viewport(), 1}, palette, frame);
    draw_scene(list, camera, palette, frame);
    leave_plain_state();
}

void Renderer::draw(std::span<const Pane> panes, const CameraPose& pose, const Palette& palette,
                    const Frame& frame) {
    std::vector<Rect> viewports;
    for (const Pane& pane : panes) viewports.push_back(pane.rect);
    reset_state();
    impl_->draw_calls = impl_->backdrop.draw(pose, viewports, palette, frame);
    for (const Pane& pane : panes) draw_scene(pane.drawn, pane.camera(pose), palette, frame);
    leave_plain_state();
}

/// Draws everything except the backdrop.
void Renderer::draw_scene(const DrawList& list, const Camera& camera, const Palette& palette,
                          const Frame& frame) {
    const PixelRect viewport = pixel_rect(camera.viewport(), frame);
    if (viewport.size.x <= 0 || viewport.size.y <= 0) return;
    const glm::ivec2 size = frame.framebuffer_size;
    int calls = impl_->shadows.prepare(list, camera, palette.shadow, viewport);
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glEnable(GL_SCISSOR_TEST);
    glScissor(viewport.min.x, viewport.min.y, viewport.size.x, viewport.size.y);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    // The ground is drawn in the camera's clip space, everything else in framebuffer pixels.
    glViewport(viewport.min.x, viewport.min.y, viewport.size.x, viewport.size.y);
    calls += impl_->shadows.draw(camera);
    glViewport(0, 0, size.x, size.y);
    calls += impl_->mesh.draw(list.mesh, camera, frame);
    calls += impl_->skins.draw(list.skins, true, camera, frame);
    impl_->strokes.prepare(list, camera, frame);
    calls += impl_->strokes.draw(Layer::Scene);
    calls += impl_->mesh.draw(list.veil, camera, frame, veil_opacity);
    calls += impl_->skins.draw(list.skins, false, camera, frame);
    if (!list.overlay.indices.empty()) {
        glClear(GL_DEPTH_BUFFER_BIT);
        calls += impl_->mesh.draw(list.overlay, camera, frame);
    }
    calls += impl_->strokes.draw(Layer::Overlay);
    impl_->draw_calls += calls;
}

int Renderer::draw_calls() const {
    return impl_->draw_calls;
}

}  // namespace tendril::app
