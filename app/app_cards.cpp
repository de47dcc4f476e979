// The open lab's card of things to try: which of its steps are done.
#include "app/app.hpp"
#include "app/document/json_complete.hpp"
#include "app/document/workspace.hpp"
#include "app/shell/card_watch.hpp"

namespace tendril::app {

const Card* App::shown_card() const {
    const std::span<const Card> cards = cards_.of(workspace_.lab);
    if (cards.empty() || !layout_.right_open || !card_shown(workspace_.settings, workspace_.lab))
        return nullptr;
    const auto progress = workspace_.ui.cards.find(workspace_.lab);
    return &cards[progress == workspace_.ui.cards.end() ? 0 : progress->second.card];
}

void App::watch_shown_card() {
    if (const Card* const card = shown_card())
        watch_card(
            workspace_.ui.cards[workspace_.lab], *card, workspace_.document.parts().at(workspace_.lab),
            [this] { return lab_state(); }, pointer_.dragged() != no_pick);
}

bool App::card_is_due() const {
    if (shown_card() == nullptr) return false;
    const auto progress = workspace_.ui.cards.find(workspace_.lab);
    return progress == workspace_.ui.cards.end() ||
           card_waits(progress->second, workspace_.document.parts().at(workspace_.lab));
}

/// The card's title, which steps are done, and the pixel of the ring around the handle to drag.
Json App::card_state() const {
    Json done = Json::array();
    const auto progress = workspace_.ui.cards.find(workspace_.lab);
    for (std::size_t i = 0; i < shown_card()->steps.size(); ++i)
        done.push_back(progress != workspace_.ui.cards.end() && i < progress->second.done.size() &&
                       progress->second.done[i]);
    const auto& ring = shell_.card_ring();
    return {{"title", shown_card()->title},
            {"done", std::move(done)},
            {"ring", ring ? pixel(*ring) : Json(nullptr)}};
}

}  // namespace tendril::app
