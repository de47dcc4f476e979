// Loads the GL entry points. They are global variables inside glad: one window at a time.
#pragma once

#include <glad/gl.h>

#include <glm/vec2.hpp>
#include <string>

namespace tendril::app {

/// A shader's first line, and what comes before its own text.
#ifdef __EMSCRIPTEN__
inline constexpr char shader_version[] = "#version 300 es";
inline constexpr char shader_precision[] = "precision highp float;\nprecision highp sampler2D;\n";
#else
inline constexpr char shader_version[] = "#version 330 core";
inline constexpr char shader_precision[] = "";
#endif

/// Loads GL through `load` and checks that the current context is 3.3 or newer; otherwise throws
/// std::runtime_error that names `backend`.
void load_gl(GLADloadfunc load, const std::string& backend);

/// Resets state that GL has and WebGL does not.
void reset_desktop_state();

/// Throws std::runtime_error unless both sides are between 1 and 16384 pixels.
void check_window_size(glm::ivec2 size);

}  // namespace tendril::app
