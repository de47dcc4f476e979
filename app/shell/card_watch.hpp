// Sees when a step of a card has happened.
#pragma once

#include <functional>

#include "app/document/card_progress.hpp"
#include "app/labs/card.hpp"

namespace tendril::app {

/// Marks the steps that have happened by now. `state` is asked for only when the part is another than was
/// seen last and there is a step to be done; of a large part not every tick.
void watch_card(CardProgress& progress, const Card& card, const std::shared_ptr<const Part>& part,
                const std::function<Json()>& state);
/// Whether the next tick may find a step done without any event.
bool card_waits(const CardProgress& progress, const std::shared_ptr<const Part>& part);

/// The first step that has not happened; as many as there are where all have.
std::size_t current_step(const CardProgress& progress, const Card& card);

}  // namespace tendril::app
