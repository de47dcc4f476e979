// Edits a curve by its keys: drag to move one, double-click to add one, right-click to remove one. The active
// key's tangents are dragged by their ends.
#pragma once

#include <glm/vec3.hpp>
#include <tendril/signal/curve.hpp>

namespace tendril::app {

/// True in a frame in which the user changed the curve. Fills the available width; `height` is in lines of
/// text. `input`, in 0 to 1 of the source range, is shown as a point on the curve; values outside are not
/// shown.
bool curve_editor(const char* id, signal::Curve& curve, glm::vec3 colour, float height, double input);

}  // namespace tendril::app
