// The look of the panels: Dear ImGui's style from the palette, and the fonts.
#pragma once

#include "app/view/palette.hpp"
#include "app/widgets/icons.hpp"

namespace tendril::app {

void apply_theme(Theme theme, float scale);

}  // namespace tendril::app
