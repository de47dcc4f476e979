// Scene commands: new, open, save, recover and quit.
#include <algorithm>

#include "app/document/autosave.hpp"
#include "app/document/command.hpp"
#include "app/document/refused.hpp"
#include "app/document/scene_file.hpp"
#include "app/system/atomic_file.hpp"

namespace tendril::app {
namespace {

void add_file_commands(CommandTable& table) {
    table.add("scene.new", "Start a new scene", {}, "Starts a new scene; undo restores the old one",
              Effect::Edit, [](Workspace& w, const Arguments&) {
                  w.document = w.blank;
                  w.saved = w.blank;
                  w.path.clear();
                  w.start_anew();
                  w.camera = w.first_view_of(w.lab);
              });
    table.add("scene.open", "Open a scene file", {text_argument("path", true, "the scene file")},
              "Opens a scene file; undo restores the scene before it", Effect::Edit,
              [](Workspace& w, const Arguments& a) {
                  load_scene_file(w, a.text("path"));
                  w.close_file_dialog();
              });
    table.add("scene.save", "Save the scene to a file",
              {text_argument("path", false, "file to save to; default: the scene's own")},
              "Saves the scene; if that fails, the old file is unchanged", Effect::Look,
              [](Workspace& w, const Arguments& a) {
                  const std::filesystem::path path =
                      a.has("path") ? std::filesystem::path(a.text("path")) : w.path;
                  if (path.empty()) throw Refused("path is missing; the scene has no file yet");
                  save_scene_file(w, path);
                  w.ui.quit = w.ui.quit || w.ui.file_dialog == UiState::FileDialog::SaveAndQuit;
                  w.close_file_dialog();
                  w.toast("Saved: " + shown_path(path));
              });
}

/// The path argument. Refuses a path that is not offered for recovery.
std::filesystem::path offered(const Workspace& workspace, const Arguments& given) {
    const auto& offers = workspace.ui.recoverable;
    const std::filesystem::path path = given.text("path");
    if (std::ranges::find(offers, path, &Recoverable::file) == offers.end()) {
        throw Refused("there is nothing to recover at " + path.string());
    }
    return path;
}

void answered(Workspace& workspace, const std::filesystem::path& file) {
    std::erase_if(workspace.ui.recoverable, [&](const Recoverable& each) { return each.file == file; });
}

void add_recovery_commands(CommandTable& table) {
    const Argument path =
        offering(text_argument("path", true, "an autosave that a crash left"), [](const Workspace& w) {
            std::vector<std::string> files;
            for (const Recoverable& each : w.ui.recoverable) files.push_back(each.file.string());
            return files;
        });
    table.add("scene.recover", "Recover unsaved work", {path}, "Recovers unsaved work after a crash",
              Effect::Edit, [](Workspace& w, const Arguments& a) {
                  const std::filesystem::path file = offered(w, a);
                  Autosave::recover(w, file);
                  answered(w, file);
                  w.toast("Recovered. It is not saved yet.");
              });
    table.add("scene.discard", "Delete unsaved work", {path}, "Deletes unsaved work that a crash left",
              Effect::Look, [](Workspace& w, const Arguments& a) {
                  const std::filesystem::path file = offered(w, a);
                  std::filesystem::remove(file);
                  answered(w, file);
              });
    table.add("scene.recover_later", "Ask about unsaved work later", {},
              "Asks again about unsaved work at the next start", Effect::Look,
              [](Workspace& w, const Arguments&) { w.ui.recoverable.clear(); });
}

void add_dialog_commands(CommandTable& table) {
    table.add("scene.open_dialog", "Choose a file to open",
              {text_argument("by", false, "the command that opens it, as in file.open")},
              "Shows a dialog to open a scene or a file that a lab reads", Effect::Look,
              [](Workspace& w, const Arguments& a) {
                  w.ui.file_dialog = UiState::FileDialog::Open;
                  w.ui.browses_for = a.has("by") ? a.text("by") : std::string();
              });
    table.add("scene.save_dialog", "Save the scene",
              {switch_argument("ask", "asks for a name even if the scene has one")},
              "Saves the scene; asks for a name if it has no file yet", Effect::Look,
              [](Workspace& w, const Arguments& a) {
                  if (w.path.empty() || (a.has("ask") && a.boolean("ask"))) {
                      w.ui.file_dialog = UiState::FileDialog::SaveAs;
                  } else {
                      save_scene_file(w, std::filesystem::path(w.path));
                      w.toast("Saved: " + shown_path(w.path));
                  }
              });
}

void quit(Workspace& w, const Arguments& given) {
    const std::string unsaved = given.has("unsaved") && w.modified() ? given.text("unsaved") : "discard";
    const bool asks = given.has("unsaved") && given.text("unsaved") == "ask";
    if (asks && w.ui.filming)
        throw Refused(w.ui.filming->name + " is still being written; wait for it, or cancel it with Escape");
    if (unsaved == "save" && !w.path.empty()) save_scene_file(w, std::filesystem::path(w.path));
    const bool needs_name = unsaved == "save" && w.path.empty();
    w.ui.asks_to_quit = unsaved == "ask";
    w.ui.quit = w.ui.quit || (!w.ui.asks_to_quit && !needs_name);
    if (needs_name) w.ui.file_dialog = UiState::FileDialog::SaveAndQuit;
}

void add_quit_command(CommandTable& table) {
    table.add("quit", "Quit Tendril",
              {choice_argument("unsaved", false, "what to do with unsaved work; default: discard",
                               {"ask", "save", "discard"})},
              "Quits the program", Effect::Look, quit);
}

}  // namespace

void add_scene_commands(CommandTable& table) {
    add_file_commands(table);
    add_recovery_commands(table);
    add_dialog_commands(table);
    add_quit_command(table);
}

}  // namespace tendril::app
