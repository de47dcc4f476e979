// Detects when the steps of a card are done.
#pragma once

#include <functional>

#include "app/document/card_progress.hpp"
#include "app/labs/card.hpp"

namespace tendril::app {

/// Marks the steps that are done. Calls `state` only if the part has changed since the last check and a step
/// is left; for a large part not every tick.
void watch_card(CardProgress& progress, const Card& card, const std::shared_ptr<const Part>& part,
                const std::function<Json()>& state);
/// Whether the next tick may find a step done even without an event.
bool card_waits(const CardProgress& progress, const std::shared_ptr<const Part>& part);

/// Index of the first step that is not done; the number of steps if all are.
std::size_t current_step(const CardProgress& progress, const Card& card);

}  // namespace tendril::app
