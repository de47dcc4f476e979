#include "app/view/renderer.hpp"

#include <cmath>

#include "app/view/renderer_ground.hpp"
#include "app/view/renderer_strokes.hpp"

namespace tendril::app {

struct Renderer::Impl {
    Program background{"background.vert", "background.frag"};
    Instances whole{0, {}};
    GroundPass ground;
    StrokePass strokes;
    int draw_calls = 0;

    int draw_background(const Palette& palette, glm::ivec2 size) const {
        glDisable(GL_BLEND);
        glDisable(GL_DEPTH_TEST);
        background.use();
        background.set("top", palette.background_top);
        background.set("bottom", palette.background_bottom);
        background.set("height", static_cast<float>(size.y));
        whole.draw(0, 1);
        return 1;
    }
};

namespace {

/// The camera's viewport in framebuffer pixels, within the framebuffer.
PixelRect pixel_rect(const Rect& viewport, const Frame& frame) {
    const glm::vec2 limit(frame.framebuffer_size);
    const glm::vec2 low = glm::clamp(glm::round(viewport.min * frame.pixel_ratio), glm::vec2(0.0f), limit);
    const glm::vec2 high = glm::clamp(glm::round(viewport.max * frame.pixel_ratio), low, limit);
    return {glm::ivec2(low.x, limit.y - high.y), glm::ivec2(high - low)};
}

/// Whatever was drawn before (the panels, too) may have left these as it liked.
void reset_state() {
    glDisable(GL_CULL_FACE);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_PRIMITIVE_RESTART);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDepthRange(0.0, 1.0);
    glBindSampler(0, 0);
}

}  // namespace

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;

void Renderer::draw(const DrawList& list, const Camera& camera, const Palette& palette, const Frame& frame) {
    const PixelRect viewport = pixel_rect(camera.viewport(), frame);
    const bool seen = viewport.size.x > 0 && viewport.size.y > 0;
    int calls = 0;
    reset_state();
    if (seen) calls += impl_->ground.draw_shadows(list, camera, palette.shadow, viewport);

    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glViewport(0, 0, frame.framebuffer_size.x, frame.framebuffer_size.y);
    glClearDepth(1.0);
    glClear(GL_DEPTH_BUFFER_BIT);
    calls += impl_->draw_background(palette, frame.framebuffer_size);
    if (seen) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(viewport.min.x, viewport.min.y, viewport.size.x, viewport.size.y);
        // The ground's geometry is in the camera's own clip space, the strokes' in pixels of the framebuffer.
        glViewport(viewport.min.x, viewport.min.y, viewport.size.x, viewport.size.y);
        calls += impl_->ground.draw_ground(camera, palette, frame, viewport);
        glViewport(0, 0, frame.framebuffer_size.x, frame.framebuffer_size.y);
        impl_->strokes.prepare(list, camera, frame);
        calls += impl_->strokes.draw(Layer::Scene);
        calls += impl_->strokes.draw(Layer::Overlay);
        glDisable(GL_SCISSOR_TEST);
    }
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glUseProgram(0);
    impl_->draw_calls = calls;
}

int Renderer::draw_calls() const {
    return impl_->draw_calls;
}

}  // namespace tendril::app
