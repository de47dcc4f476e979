#include "app/window/gl.hpp"

#include <stdexcept>

namespace tendril::app {

#ifdef __EMSCRIPTEN__
void reset_desktop_state() {}
#else
void reset_desktop_state() {
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_PRIMITIVE_RESTART);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glDepthRange(0.0, 1.0);
    glClearDepth(1.0);
}

void load_gl(GLADloadfunc load, const std::string& backend) {
    const int version = gladLoadGL(load);
    if (version == 0) throw std::runtime_error(backend + ": OpenGL could not be loaded");
    if (version < GLAD_MAKE_VERSION(3, 3)) {
        throw std::runtime_error(backend + ": OpenGL 3.3 is needed, this is " +
                                 std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                                 std::to_string(GLAD_VERSION_MINOR(version)));
    }
}
#endif

void check_window_size(glm::ivec2 size) {
    constexpr int largest = 16384;
    if (size.x < 1 || size.y < 1 || size.x > largest || size.y > largest) {
        throw std::runtime_error("a window of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                                 " pixels: each side must be between 1 and " + std::to_string(largest));
    }
}

}  // namespace tendril::app
