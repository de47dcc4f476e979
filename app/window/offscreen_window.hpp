// What the windows without a screen share: nothing ever happens to them, the clipboard is a string, and they
// draw into a framebuffer object, so that the ways to get a context don't differ in anything that is drawn.
#pragma once

#include <string>

#include "app/window/gl.hpp"
#include "app/window/window.hpp"

namespace tendril::app {

/// 8-bit RGBA and 24 bits of depth. Needs its context current for as long as it lives.
class OffscreenFramebuffer {
  public:
    explicit OffscreenFramebuffer(glm::ivec2 size);
    ~OffscreenFramebuffer();
    OffscreenFramebuffer(const OffscreenFramebuffer&) = delete;
    OffscreenFramebuffer& operator=(const OffscreenFramebuffer&) = delete;

    unsigned name() const { return framebuffer_; }
    glm::ivec2 size() const { return size_; }
    /// Throws std::runtime_error where the driver has no memory for it.
    void resize(glm::ivec2 size);

  private:
    void free();

    GLuint framebuffer_ = 0, colour_ = 0, depth_ = 0;
    glm::ivec2 size_{0};
};

/// `Context` makes a GL context current and loads GL when it is made, and ends it when it goes.
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
