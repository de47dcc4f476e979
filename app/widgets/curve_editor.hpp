// A curve that is edited by its keys: drag them, double-click to add one, right-click to remove it. The
// active key's tangents are dragged by their ends.
#pragma once

#include <glm/vec3.hpp>
#include <tendril/signal/curve.hpp>

namespace tendril::app {

/// True in a frame in which a person changed the curve. As wide as there is room, `height` in lines of text.
/// `input`, from 0 to 1 of the source range, is shown as a point on it; others are not shown.
bool curve_editor(const char* id, signal::Curve& curve, glm::vec3 colour, float height, double input);

}  // namespace tendril::app
