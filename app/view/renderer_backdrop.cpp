#include "app/view/renderer_backdrop.hpp"

namespace tendril::app {

PixelRect pixel_rect(const Rect& viewport, const Frame& frame) {
    const glm::vec2 limit(frame.framebuffer_size);
    const glm::vec2 low = glm::clamp(glm::round(viewport.min * frame.pixel_ratio), glm::vec2(0.0f), limit);
    const glm::vec2 high = glm::clamp(glm::round(viewport.max * frame.pixel_ratio), low, limit);
    return {glm::ivec2(low.x, limit.y - high.y), glm::ivec2(high - low)};
}

Backdrop::Backdrop() {
    glGenFramebuffers(1, &framebuffer_);
    glGenRenderbuffers(1, &colour_);
}

Backdrop::~Backdrop() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &colour_);
}

int Backdrop::draw_directly(const Key& key, const Palette& palette, const Frame& frame) const {
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, frame.framebuffer_size.x, frame.framebuffer_size.y);
    int calls = background_.draw(palette, frame);
    if (!frame.grid) return calls;
    glEnable(GL_SCISSOR_TEST);
    for (const Rect& each : key.viewports) {
        const PixelRect viewport = pixel_rect(each, frame);
        if (viewport.size.x <= 0 || viewport.size.y <= 0) continue;
        glScissor(viewport.min.x, viewport.min.y, viewport.size.x, viewport.size.y);
        glViewport(viewport.min.x, viewport.min.y, viewport.size.x, viewport.size.y);
        calls += grid_.draw(Camera(key.pose, each), palette, frame);
    }
    return calls;
}

void Backdrop::cache(const Key& key, const Palette& palette, const Frame& frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    if (size_ != frame.framebuffer_size) {
        size_ = frame.framebuffer_size;
        glBindRenderbuffer(GL_RENDERBUFFER, colour_);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size_.x, size_.y);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    }
    cached_calls_ = draw_directly(key, palette, frame);
}

int Backdrop::draw(const CameraPose& pose, std::span<const Rect> viewports, const Palette& palette,
                   const Frame& frame) {
    const Key key{pose,
                  {viewports.begin(), viewports.end()},
                  {palette.background_top, palette.background_bottom, palette.grid, palette.axis_x,
                   palette.axis_y, palette.axis_z},
                  frame.framebuffer_size,
                  frame.pixel_ratio,
                  frame.grid,
                  frame.dither};
    const bool still = last_ == key;
    last_ = key;
    if (!still) {
        glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
        return draw_directly(key, palette, frame);
    }
    if (cached_ != key) cache(key, palette, frame);
    cached_ = key;
    const glm::ivec2 size = frame.framebuffer_size;
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, frame.framebuffer);
    glBlitFramebuffer(0, 0, size.x, size.y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    return cached_calls_;
}

}  // namespace tendril::app
