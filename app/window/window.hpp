// A window with a GL 3.3 core context and events, on or off screen, using GLFW, EGL or OSMesa. The frame loop
// (app.cpp) runs the same code on each.
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

    /// Size in window coordinates, like the mouse's.
    virtual glm::ivec2 size() const = 0;
    /// Size in pixels, as for glViewport.
    virtual glm::ivec2 framebuffer_size() const = 0;
    /// The system's scale for text and widgets, in window coordinates: 1 on a standard screen, 2 on a
    /// high-density one. (1 on both if window coordinates are already scaled, as under Wayland.)
    virtual float content_scale() const { return 1.0f; }
    /// The GL name of the framebuffer to draw in.
    virtual unsigned framebuffer() const { return 0; }

    /// Appends the events since the last call, in order, after waiting for one for at most `seconds`. Off
    /// screen there are no events, and it does not wait.
    virtual void poll(std::vector<Event>& events, double seconds) = 0;
    /// Shows the finished picture.
    virtual void present() = 0;
    /// Changes the size; a real window may refuse or delay it.
    virtual void resize(glm::ivec2 size) = 0;
    /// Shrinks a window that is larger than the free part of its screen.
    virtual void fit_screen() {}

    virtual void set_cursor(Cursor) {}
    virtual void set_title(const std::string&) {}
    /// Opens the system's file dialog; the chosen file arrives as a Drop. False: the program shows its own.
    virtual bool choose_file() { return false; }
    virtual std::string clipboard() = 0;
    virtual void set_clipboard(const std::string& text) = 0;
};

enum class Backend { Glfw, OsMesa, Egl };

/// Opens a window of that kind with its context current and GL loaded. Throws std::runtime_error with a
/// one-line reason if that fails ("no display: ..."). `Glfw` needs a display; the others do not.
std::unique_ptr<Window> open_window(Backend backend, glm::ivec2 size);

/// Opens an off-screen window with OSMesa or, if that fails, with EGL without a surface.
std::unique_ptr<Window> open_offscreen(glm::ivec2 size);

// Off screen through EGL without a surface (EGL_MESA_platform_surfaceless), drawing into a framebuffer
// object. Needed since Mesa 25.1, which removed OSMesa.

std::unique_ptr<Window> open_egl_window(glm::ivec2 size);

// Off screen with OSMesa, Mesa's software rasteriser: needs no display and no graphics card.

std::unique_ptr<Window> open_osmesa_window(glm::ivec2 size);

// Windows of the system: on the screen, or hidden to draw off screen.

std::unique_ptr<Window> open_glfw_window(glm::ivec2 size);
std::unique_ptr<Window> open_hidden_window(glm::ivec2 size);

}  // namespace tendril::app
