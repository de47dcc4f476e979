// The colours that only this lab needs; view/palette.hpp has the rest.
#pragma once

#include <tendril/ik/method.hpp>

#include "app/view/palette.hpp"

namespace tendril::app {

glm::vec3 pole_colour(const Palette& palette);
/// Of a solver in a race; told apart by lightness too.
glm::vec3 solver_colour(const Palette& palette, ik::Method method);

}  // namespace tendril::app
