// The card of things to try, at the bottom of the right panel, and the highlight on the widget of its current
// step.
#pragma once

#include <optional>

#include "app/shell/shell.hpp"

namespace tendril::app {

/// The card's height in a panel of that width and height; 0 if none is shown. It takes at most half of the
/// panel: if there is too little room it shows only the current step, or only its title.
float card_height(const ShellFrame& frame, glm::vec2 panel);
/// Fills the current window; `panel` as above.
void show_card(const ShellFrame& frame, glm::vec2 panel, Emit& emit);
/// The current step of the shown card; null if there is no card or all steps are done.
const CardStep* step_to_do(const ShellFrame& frame);
/// Highlights the current step's section if it is in this side panel. Call it while filling the panel.
void light_card_section(const ShellFrame& frame, bool left);
/// Draws a ring around the handle of the current step if the scene shows it, and returns its position.
/// `known` caches the handle's pick from frame to frame.
std::optional<glm::vec2> show_card_halo(const ShellFrame& frame, PickId& known);

}  // namespace tendril::app
