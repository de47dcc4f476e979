// What a person takes along: text on the clipboard.
#include "app/document/scene_file.hpp"
#include "app/labs/chain/command_support.hpp"

namespace tendril::app {

void add_copy_commands(CommandTable& table) {
    table.add({.name = "chain.copy",
               .arguments = {choice_argument("as", true, "the scene as text", {"json"})},
               .help = "Puts the scene on the clipboard",
               .effect = Effect::Look,
               .apply = [](Workspace& workspace, const Arguments&) {
                   workspace.ui.copied = json_to_text(save_scene(workspace));
                   workspace.toast("The scene is on the clipboard, as JSON.");
               }});
    table.add({.name = "race.copy",
               .arguments = {},
               .help = "Puts every solver's residual at each iteration on the clipboard, as CSV",
               .effect = Effect::Look,
               .apply = [](Workspace& workspace, const Arguments&) {
                   const ChainPart& part = workspace.document.get<ChainPart>(chain_lab);
                   if (!part.study.race) throw Refused("no race is open");
                   workspace.ui.copied = race_csv(*part.study.race);
                   workspace.toast("The race is on the clipboard, as CSV.");
               }});
}

}  // namespace tendril::app
