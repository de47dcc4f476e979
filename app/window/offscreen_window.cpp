#include "app/window/offscreen_window.hpp"

#include <stdexcept>

namespace tendril::app {

OffscreenFramebuffer::OffscreenFramebuffer(glm::ivec2 size) {
    glGenFramebuffers(1, &framebuffer_);
    glGenRenderbuffers(1, &colour_);
    glGenRenderbuffers(1, &depth_);
    try {
        resize(size);
    } catch (...) {
        free();
        throw;
    }
}

OffscreenFramebuffer::~OffscreenFramebuffer() {
    free();
}

void OffscreenFramebuffer::free() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &colour_);
    glDeleteRenderbuffers(1, &depth_);
}

void OffscreenFramebuffer::resize(glm::ivec2 size) {
    if (size == size_) return;
    glBindRenderbuffer(GL_RENDERBUFFER, colour_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size.x, size.y);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size.x, size.y);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw std::runtime_error("no memory to draw " + std::to_string(size.x) + "x" +
                                 std::to_string(size.y) + " pixels off screen");
    }
    size_ = size;
}

}  // namespace tendril::app
