#include "app/window/window.hpp"

#include <stdexcept>
#include <string>

#include "app/window/gl.hpp"

namespace tendril::app {

std::unique_ptr<Window> open_window(Backend backend, glm::ivec2 size) {
    check_window_size(size);
    switch (backend) {
        case Backend::Glfw:
            return open_glfw_window(size);
        case Backend::OsMesa:
            return open_osmesa_window(size);
        case Backend::Egl:
            return open_egl_window(size);
    }
    throw std::runtime_error("no such kind of window");
}

std::unique_ptr<Window> open_offscreen(glm::ivec2 size) {
    check_window_size(size);
    std::string tried;
    for (const auto open : {open_osmesa_window, open_egl_window, open_hidden_window}) {
        try {
            return open(size);
        } catch (const std::runtime_error& error) {
            tried += (tried.empty() ? "" : "; ") + std::string(error.what());
        }
    }
    throw std::runtime_error("nothing to draw with off screen: " + tried);
}

}  // namespace tendril::app
