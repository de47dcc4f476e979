// The 3D view, usually one pane, several with one camera if a lab compares things; and the card beside it.
#include <algorithm>
#include <cmath>

#include "app/app.hpp"
#include "app/document/workspace.hpp"
#include "app/io/json_complete.hpp"
#include "app/shell/card_watch.hpp"
#include "app/shell/gizmo_view.hpp"
#include "app/shell/labels_view.hpp"
#include "app/video_take.hpp"

namespace tendril::app {

/// Keeps each pane's draw list until the next picture: it is what the user sees and picks.
void App::divide_view() {
    const std::vector<Rect> rects =
        tiled(layout_.view, lab().panes(workspace_).size(), std::round(pane_gap * layout_.scale));
    panes_.resize(rects.size());
    for (std::size_t i = 0; i < rects.size(); ++i) panes_[i].rect = rects[i];
    workspace_.ui.view_size = rects.front().size();
    workspace_.ui.picture_size = picture_view({0, 0}).size;
    if (pane_ >= panes_.size()) pane_ = 0;
}

/// A drag stays in the pane where it began.
const Pane& App::pane_at_hand() {
    if (!pointer_.busy()) {
        for (std::size_t i = 0; i < panes_.size(); ++i)
            if (panes_[i].rect.contains(input_.mouse())) pane_ = i;
    }
    return panes_[pane_];
}

/// Each pane's title and corners, in window coordinates.
Json App::panes_state() const {
    Json state = Json::array();
    const std::vector<PaneTitle> titles = lab().panes(workspace_);
    for (std::size_t i = 0; i < std::min(panes_.size(), titles.size()); ++i)
        state.push_back({{"title", titles[i].text},
                         {"min", pixel(panes_[i].rect.min)},
                         {"max", pixel(panes_[i].rect.max)}});
    return state;
}

void App::draw_panes() {
    const Palette& colours = palette(workspace_.settings.theme);
    pointer_.forget_missing(workspace_, lab());
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        Pane& pane = panes_[i];
        const Camera camera = pane.camera(workspace_.camera);
        pane.drawn.clear();
        const View view{workspace_,         camera,        colours, pointer_.hovered(),
                        pointer_.dragged(), layout_.scale, i};
        lab().draw(view, pane.drawn);
        show_gizmo(pane.drawn, lab(), view, pointer_);
        show_constraint(pane.drawn, lab(), view, pointer_, input_);
        show_labels(pane.drawn, camera, colours, layout_.scale, shell_.overlays());
    }
    if (const auto box = pointer_.box()) show_selection_box(*box, colours, layout_.scale);
    if (const auto stroke = pointer_.stroke())
        show_stroke(stroke->first, stroke->second, colours, layout_.scale);
    show_pane_titles(panes_, lab().panes(workspace_), colours, layout_.scale, true);
}

// The open lab's card of things to try.

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
