// Detects when the steps of a card are done.
#pragma once

#include <functional>

#include "app/document/card_progress.hpp"
#include "app/labs/card.hpp"

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
/// Whether the next tick may complete a step even without an event.
bool card_waits(const CardProgress& progress, const std::shared_ptr<const Part>& part);

/// Index of the first step that is not done; the number of steps if all are.
std::size_t current_step(const CardProgress& progress, const Card& card);

}  // namespace tendril::app
