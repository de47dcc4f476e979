// The card of things to try: at the foot of the right panel, beside the scene; and what lights up where its
// current step is done.
#pragma once

#include "app/shell/shell.hpp"

namespace tendril::app {

/// How high the card is in a panel of that width and height, 0 where none is shown. It takes no more than
/// half of the panel: where there is too little room for its steps it folds to the current one, or to its
/// title.
float card_height(const ShellFrame& frame, glm::vec2 panel);
/// Fills the window that is begun, `panel` as above.
void show_card(const ShellFrame& frame, glm::vec2 panel, Emit& emit);
/// Lights up the section of the side panel that is being filled, if the current step is done there.
void light_card_section(const ShellFrame& frame, bool left);
/// A ring around the handle with which the current step is done, in the view. `known` is that handle's pick,
/// from frame to frame.
void show_card_halo(const ShellFrame& frame, PickId& known);

}  // namespace tendril::app
