// The view that a window opens with: a moving scene, and the cards of things to try.
#pragma once

#include "app/app.hpp"
#include "app/session.hpp"

namespace tendril::app {

/// Whether the session has a window and was given no scene, lab or script.
bool opens_alive(const SessionOptions& options);
/// Sets up every lab's opening as a new scene: nothing to undo, nothing to save. The openings move by
/// themselves until the user takes over (Lab::calm()), which does not mark the scene as modified.
void open_alive(App& app);
/// Shows each lab's card unless it was shown or hidden before.
void offer_cards(App& app);

}  // namespace tendril::app
