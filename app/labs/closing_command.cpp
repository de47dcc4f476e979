#include "app/labs/closing_command.hpp"

#include "app/document/command.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {
namespace {

/// By the lab's own commands. They only look: none is a step of undo.
void select_nothing(Workspace& workspace, const Lab& lab) {
    Emit emit;
    lab.deselect(workspace, emit);
    CommandTable own;
    lab.add_commands(own);
    for (const Emitted& each : emit.take()) own.find(each.name)->apply(workspace, Arguments(*each.arguments));
}

}  // namespace

void add_closing_command(CommandTable& table, const Labs& labs) {
    table.add({.name = "view.close",
               .title = "Close, cancel or select nothing",
               .arguments = {},
               .help = "Closes the palette, help, settings or dialog; where none is open, selects nothing",
               .effect = Effect::Look,
               .apply = [&labs](Workspace& w, const Arguments&) {
                   if (!w.ui.covered()) select_nothing(w, *labs.find(w.lab));
                   w.ui.help = w.ui.palette = w.ui.settings = false;
                   w.ui.file_dialog = UiState::FileDialog::None;
                   w.ui.asks_to_quit = false;
                   w.ui.toasts.clear();
               }});
}

}  // namespace tendril::app
