// Loads the GL entry points. They are global variables inside glad: one window at a time.
#pragma once

#include <glad/gl.h>

#include <glm/vec2.hpp>
#include <string>

namespace tendril::app {

/// Loads GL through `load` and checks that the current context is 3.3 or newer; otherwise throws
/// std::runtime_error that names `backend`.
void load_gl(GLADloadfunc load, const std::string& backend);

/// Throws std::runtime_error unless both sides are between 1 and 16384 pixels.
void check_window_size(glm::ivec2 size);

}  // namespace tendril::app
