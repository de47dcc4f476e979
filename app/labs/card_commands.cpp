#include "app/labs/card_commands.hpp"

#include "app/document/card_progress.hpp"
#include "app/document/command.hpp"
#include "app/labs/card.hpp"
#include "app/view/assets.hpp"

namespace tendril::app {
namespace {

/// The index of the card to show: the given one, or the last one shown.
std::size_t card_index(const Workspace& w, const Arguments& given) {
    if (!given.has("number")) {
        const auto shown = w.ui.cards.find(w.lab);
        return shown == w.ui.cards.end() ? 0 : shown->second.card;
    }
    const int number = given.integer("number");
    const std::size_t count = read_cards(cards_source(w.lab)).size();
    if (number < 1 || static_cast<std::size_t>(number) > count)
        throw Refused("number must be 1 to " + std::to_string(count) + ", got " + std::to_string(number));
    return static_cast<std::size_t>(number) - 1;
}

}  // namespace

void add_card_commands(CommandTable& table) {
    table.add({.name = "view.card",
               .title = "Show or hide things to try",
               .arguments = {{.name = "open",
                              .type = ArgumentType::Boolean,
                              .required = false,
                              .help = "true restarts the card; toggles when left out, but for a number"},
                             {.name = "number",
                              .type = ArgumentType::Integer,
                              .required = false,
                              .help = "card number, from 1; the last one shown when left out"}},
               .help = "Shows one of this lab's cards of things to try, or puts it away for good",
               .effect = Effect::Look,
               .apply = [](Workspace& w, const Arguments& given) {
                   if (cards_source(w.lab).empty()) throw Refused("this lab has no card");
                   const std::size_t card = card_index(w, given);
                   const bool seen = card_shown(w.settings, w.lab) && w.settings.right_open;
                   const bool open = given.has("open") ? given.boolean("open") : given.has("number") || !seen;
                   show_card(w.settings, w.lab, open);
                   if (!open) return;
                   w.settings.right_open = true;  // where it stands
                   w.ui.cards[w.lab] = {.card = card};
               }});
}

}  // namespace tendril::app
