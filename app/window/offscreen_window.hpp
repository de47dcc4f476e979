// What the windows without a screen share: nothing ever happens to them, and the clipboard is a string.
#pragma once

#include <string>

#include "app/window/window.hpp"

namespace tendril::app {

class OffscreenWindow : public Window {
  public:
    glm::ivec2 size() const override { return size_; }
    glm::ivec2 framebuffer_size() const override { return size_; }
    void poll(std::vector<Event>&, double) override {}
    std::string clipboard() override { return clipboard_; }
    void set_clipboard(const std::string& text) override { clipboard_ = text; }

  protected:
    explicit OffscreenWindow(glm::ivec2 size) : size_(size) {}

    glm::ivec2 size_;

  private:
    std::string clipboard_;
};

}  // namespace tendril::app
