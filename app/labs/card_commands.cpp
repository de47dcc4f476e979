#include "app/labs/card_commands.hpp"

#include "app/document/card_progress.hpp"
#include "app/document/command.hpp"
#include "app/view/assets.hpp"

namespace tendril::app {

void add_card_commands(CommandTable& table) {
    table.add({.name = "view.card",
               .title = "Show or hide things to try",
               .arguments = {{.name = "open",
                              .type = ArgumentType::Boolean,
                              .required = false,
                              .help = "true begins it anew; toggles when left out"}},
               .help = "Shows this lab's card of things to try, or puts it away for good",
               .effect = Effect::Look,
               .apply = [](Workspace& w, const Arguments& given) {
                   if (card_source(w.lab).empty()) throw Refused("this lab has no card");
                   const bool seen = card_shown(w.settings, w.lab) && w.settings.right_open;
                   const bool open = given.has("open") ? given.boolean("open") : !seen;
                   show_card(w.settings, w.lab, open);
                   if (!open) return;
                   w.settings.right_open = true;  // where it stands
                   w.ui.cards.erase(w.lab);
               }});
}

}  // namespace tendril::app
