#include "app/view/renderer_backdrop.hpp"

namespace tendril::app {

Backdrop::Backdrop() {
    glGenFramebuffers(1, &framebuffer_);
    glGenRenderbuffers(1, &colour_);
}

Backdrop::~Backdrop() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &colour_);
}

int Backdrop::draw_directly(const Camera& camera, const Palette& palette, const Frame& frame,
                            PixelRect viewport) const {
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, frame.framebuffer_size.x, frame.framebuffer_size.y);
    int calls = background_.draw(palette, frame.framebuffer_size);
    if (!frame.grid || viewport.size.x <= 0 || viewport.size.y <= 0) return calls;
    glEnable(GL_SCISSOR_TEST);
    glScissor(viewport.min.x, viewport.min.y, viewport.size.x, viewport.size.y);
    glViewport(viewport.min.x, viewport.min.y, viewport.size.x, viewport.size.y);
    calls += grid_.draw(camera, palette, frame);
    return calls;
}

void Backdrop::keep(const Camera& camera, const Palette& palette, const Frame& frame, PixelRect viewport) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    if (size_ != frame.framebuffer_size) {
        size_ = frame.framebuffer_size;
        glBindRenderbuffer(GL_RENDERBUFFER, colour_);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size_.x, size_.y);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    }
    draw_directly(camera, palette, frame, viewport);
}

int Backdrop::draw(const Camera& camera, const Palette& palette, const Frame& frame, PixelRect viewport) {
    const Key key{camera.pose(),
                  camera.viewport(),
                  {palette.background_top, palette.background_bottom, palette.grid, palette.axis_x,
                   palette.axis_y, palette.axis_z},
                  frame.framebuffer_size,
                  frame.pixel_ratio,
                  frame.grid};
    const bool still = last_ == key;
    last_ = key;
    if (!still) {
        glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
        return draw_directly(camera, palette, frame, viewport);
    }
    if (kept_ != key) keep(camera, palette, frame, viewport);
    kept_ = key;
    const glm::ivec2 size = frame.framebuffer_size;
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, frame.framebuffer);
    glBlitFramebuffer(0, 0, size.x, size.y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    return frame.grid && viewport.size.x > 0 && viewport.size.y > 0 ? 2 : 1;
}

}  // namespace tendril::app
