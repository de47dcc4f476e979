// A place with a GL 3.3 core context to draw in and events to read: a real window, or one off screen.
// The frame (app.cpp) runs the same code over each.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/window/event.hpp"

namespace tendril::app {

enum class Cursor { Arrow, Hand, Grab, Text, ResizeColumn };

class Window {
  public:
    virtual ~Window() = default;

    /// Size in window coordinates, those of the mouse.
    virtual glm::ivec2 size() const = 0;
    /// Size in pixels: what glViewport wants.
    virtual glm::ivec2 framebuffer_size() const = 0;
    /// The system's wish for the size of text and widgets, in window coordinates: 1 on a plain screen, 2 on a
    /// dense one. (Where window coordinates are scaled already, as under Wayland, it is 1 there too.)
    virtual float content_scale() const { return 1.0f; }
    /// The GL name of the framebuffer to draw in.
    virtual unsigned framebuffer() const { return 0; }

    /// Appends what has happened since the last call, in order, after waiting at most `seconds` for
    /// something to happen. Off screen nothing ever happens, and it does not wait.
    virtual void poll(std::vector<Event>& events, double seconds) = 0;
    /// Shows what was drawn.
    virtual void present() = 0;
    /// Changes the size; a real window may refuse or be late.
    virtual void resize(glm::ivec2 size) = 0;

    virtual void set_cursor(Cursor) {}
    virtual void set_title(const std::string&) {}
    virtual std::string clipboard() = 0;
    virtual void set_clipboard(const std::string& text) = 0;
};

enum class Backend { Glfw, OsMesa, Egl };

/// Opens a window of that kind with its context current and GL loaded. Throws std::runtime_error with a
/// single clear line where that cannot be ("no display: ..."). `Glfw` needs a display; the others do not.
std::unique_ptr<Window> open_window(Backend backend, glm::ivec2 size);

/// Opens off screen with whatever this machine has: OSMesa first, then EGL without a surface.
std::unique_ptr<Window> open_offscreen(glm::ivec2 size);

}  // namespace tendril::app
