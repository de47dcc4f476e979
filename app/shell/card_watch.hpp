// The card of things to try: detects completed steps, and draws the card.
#pragma once

#include <functional>
#include <optional>

#include "app/document/workspace.hpp"
#include "app/labs/card.hpp"
#include "app/shell/shell.hpp"

namespace tendril::app {

/// Records that a command ran at that moment, which completes steps that wait only for it. `changes`: it may
/// have changed the scene. `in_panel`: it comes from a panel or the palette, and completes no step that asks
/// for a handle.
void note_command(CardProgress& progress, const Card& card, const std::string& command, const Json& arguments,
                  bool changes, std::uint64_t moment, bool in_panel = false);
/// Marks steps whose conditions now hold too. Calls `state` only if there may be such steps, and for a large
/// part not every tick. `dragging`: a drag is under way; it counts once it ends.
void watch_card(CardProgress& progress, const Card& card, const std::shared_ptr<const Part>& part,
                const std::function<Json()>& state, bool dragging = false);
/// True if the next tick may complete a step even without an event.
bool card_waits(const CardProgress& progress, const std::shared_ptr<const Part>& part);

/// Index of the first step that is not done; the number of steps if all are.
std::size_t current_step(const CardProgress& progress, const Card& card);

// The card of things to try, at the bottom of the right panel, and the highlight on the widget of its current
// step.

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
