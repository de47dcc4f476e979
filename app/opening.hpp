// What a window opens on where it was told nothing: a scene that is alive, and the cards of things to try.
#pragma once

#include "app/app.hpp"
#include "app/session.hpp"

namespace tendril::app {

/// Whether the session is for a person at a window who asked for no scene, no lab and no script.
bool opens_alive(const SessionOptions& options);
/// The first lab's opening scene, as new as the blank one: nothing to undo, nothing to save.
void open_alive(App& app);
/// Shows the card of each lab that was never shown nor put away.
void offer_cards(App& app);

}  // namespace tendril::app
