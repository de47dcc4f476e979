// The one vocabulary of change. Every change to the document is a named command with JSON arguments, whoever
// makes it: a drag, a panel, a shortcut, a script, a test. One table holds each command's name, arguments,
// help and effect; the palette, --list-commands and the checks of arguments all come from it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/refused.hpp"
#include "app/document/workspace.hpp"

namespace tendril::app {

/// What a command does to the history.
enum class Effect {
    Edit,     ///< changes the document; can be undone
    Look,     ///< changes what is seen or chosen, in the document or around it; no undo entry
    Replace,  ///< replaces the document, or moves it in time, and looks after the history itself
};

struct Command {
    std::string name;
    /// What a person looks for, in the palette and the menus: two to six words that say what to do, without a
    /// full stop ("Add a joint at the tip"). Unique among the commands of a lab and the program's own.
    std::string title{};
    std::vector<Argument> arguments;
    std::string help;
    Effect effect = Effect::Edit;
    /// Whatever it throws becomes a refusal, with the command's name before it.
    std::function<void(Workspace&, const Arguments&)> apply{};
    /// Of what it only begins, and ticks go on with (Lab::work): does the rest at once. For scripts, whose
    /// next line finds it done.
    std::function<void(Workspace&)> finish{};
    std::string lab{};  ///< whose it is, by name; the table fills it in. Empty: the program's own
};

class CommandTable {
  public:
    void add(Command command);
    /// What is added from here on belongs to that lab.
    void begin_lab(std::string name) { lab_ = std::move(name); }
    const Command* find(std::string_view name) const;
    const std::vector<Command>& all() const { return commands_; }

    /// Checks and applies. Throws Refused (or UnknownCommand), with the workspace unchanged. `gesture` merges
    /// the undo entries of one drag.
    void run(Workspace& workspace, std::string_view name, const Json& arguments, Gesture gesture = 0) const;

  private:
    std::vector<Command> commands_;
    std::string lab_;
};

/// Checks given arguments as CommandTable::run does before it applies them. Throws Refused.
void check_arguments(const Command& command, const Json& given);

/// "chain.add length [position]", for lists and help.
std::string usage(const Command& command);

/// scene.*, view.picture, quit.
void add_scene_commands(CommandTable& table);
/// undo, redo, all of the above, camera.set, time.*, view.*: all that needs no lab.
void add_workspace_commands(CommandTable& table);

}  // namespace tendril::app
