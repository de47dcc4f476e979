#include "app/labs/card_commands.hpp"

#include "app/document/card_progress.hpp"
#include "app/document/command.hpp"
#include "app/labs/card.hpp"
#include "app/view/assets.hpp"

namespace tendril::app {
namespace {

std::size_t card_numbered(const Arguments& given, const std::string& lab) {
    const std::size_t count = read_cards(cards_source(lab)).size();
    const auto number = given.integer("number");
    if (number < 1 || static_cast<std::size_t>(number) > count)
        throw Refused("number " + std::to_string(number) + ": this lab has cards 1 to " +
                      std::to_string(count));
    return static_cast<std::size_t>(number) - 1;
}

}  // namespace

void add_card_commands(CommandTable& table) {
    table.add({.name = "view.card",
               .title = "Show or hide things to try",
               .arguments = {{.name = "open",
                              .type = ArgumentType::Boolean,
                              .required = false,
                              .help = "true begins it anew; toggles when left out"},
                             {.name = "number",
                              .type = ArgumentType::Integer,
                              .required = false,
                              .help = "which of this lab's cards, from 1; the same as before when left out"}},
               .help = "Shows one of this lab's cards of things to try, or puts it away for good",
               .effect = Effect::Look,
               .apply = [](Workspace& w, const Arguments& given) {
                   if (cards_source(w.lab).empty()) throw Refused("this lab has no card");
                   const std::size_t card =
                       given.has("number") ? card_numbered(given, w.lab) : w.ui.cards[w.lab].card;
                   const bool seen = card_shown(w.settings, w.lab) && w.settings.right_open;
                   const bool open = given.has("open") ? given.boolean("open") : given.has("number") || !seen;
                   show_card(w.settings, w.lab, open);
                   if (!open) return;
                   w.settings.right_open = true;  // where it stands
                   w.ui.cards[w.lab] = {.card = card};
               }});
}

}  // namespace tendril::app
