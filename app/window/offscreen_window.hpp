// Code shared by windows without a screen: they have no events, their clipboard is a string, and they draw
// into a framebuffer object, so the picture does not depend on how the context was created.
#pragma once

#include <string>

#include "app/window/gl.hpp"
#include "app/window/window.hpp"

namespace tendril::app {

/// 8-bit RGBA and 24 bits of depth. Its context must be current as long as it lives.
class OffscreenFramebuffer {
  public:
    explicit OffscreenFramebuffer(glm::ivec2 size);
    ~OffscreenFramebuffer();
    OffscreenFramebuffer(const OffscreenFramebuffer&) = delete;
    OffscreenFramebuffer& operator=(const OffscreenFramebuffer&) = delete;

    unsigned name() const { return framebuffer_; }
    glm::ivec2 size() const { return size_; }
    /// Throws std::runtime_error if the driver does not have enough memory.
    void resize(glm::ivec2 size);

  private:
    void free();

    GLuint framebuffer_ = 0, colour_ = 0, depth_ = 0;
    glm::ivec2 size_{0};
};

/// `Context` makes a GL context current and loads GL in its constructor, and destroys it in its destructor.
template <typename Context>
class OffscreenWindow final : public Window {
  public:
    explicit OffscreenWindow(glm::ivec2 size) : framebuffer_(size) {}

    glm::ivec2 size() const override { return framebuffer_.size(); }
    glm::ivec2 framebuffer_size() const override { return framebuffer_.size(); }
    unsigned framebuffer() const override { return framebuffer_.name(); }
    void poll(std::vector<Event>&, double) override {}
    void present() override { glFinish(); }
    void resize(glm::ivec2 size) override {
        check_window_size(size);
        framebuffer_.resize(size);
    }
    std::string clipboard() override { return clipboard_; }
    void set_clipboard(const std::string& text) override { clipboard_ = text; }

  private:
    Context context_;
    OffscreenFramebuffer framebuffer_;
    std::string clipboard_;
};

}  // namespace tendril::app
