// What a person takes along: text on the clipboard.
#include "app/document/json_complete.hpp"
#include "app/document/scene_file.hpp"
#include "app/labs/chain/code.hpp"
#include "app/labs/chain/command_support.hpp"
#include "app/labs/chain/shown.hpp"

namespace tendril::app {

void add_copy_commands(CommandTable& table) {
    table.add({.name = "chain.copy",
               .title = "Copy the chain",
               .arguments = {choice_argument("as", true, "a program against the library, or the scene",
                                             {"cpp", "json"})},
               .help = "Puts the chain on the clipboard, as code or as a scene",
               .effect = Effect::Look,
               .apply = [](Workspace& workspace, const Arguments& given) {
                   const bool code = given.text("as") == "cpp";
                   workspace.ui.copied = code ? chain_code(workspace.document.get<ChainPart>(chain_lab))
                                              : json_to_text(save_scene(workspace));
                   workspace.toast(code ? "The chain is on the clipboard, as C++."
                                        : "The scene is on the clipboard, as JSON.");
               }});
    table.add({.name = "race.copy",
               .title = "Copy the race as CSV",
               .arguments = {},
               .help = "Puts every solver's residual at each iteration on the clipboard, as CSV",
               .effect = Effect::Look,
               .apply = [](Workspace& workspace, const Arguments&) {
                   const ShownChain shown = shown_chain(workspace);
                   if (!shown.race) throw Refused("no race is open");
                   workspace.ui.copied = race_csv(*shown.race);
                   workspace.toast("The race is on the clipboard, as CSV.");
               }});
}

}  // namespace tendril::app
