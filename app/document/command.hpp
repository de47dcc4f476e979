// Every change to the document is a named command with JSON arguments, whether it comes from a drag, a panel,
// a shortcut, a script or a test. One table holds each command's name, arguments, help and effect; the
// palette, --list-commands and the argument checks come from it.
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

/// The effect of a command on the history.
enum class Effect {
    Edit,     ///< changes the document; can be undone
    Look,     ///< changes view or selection only; no undo entry
    Replace,  ///< replaces the document or moves it in time; manages the history itself
};

struct Command {
    std::string name;
    /// For the palette and menus: two to six words without a full stop ("Add a joint at the tip"). Unique
    /// among the lab's commands and the program's own.
    std::string title{};
    std::vector<Argument> arguments;
    std::string help;
    Effect effect = Effect::Edit;
    /// Any exception becomes a refusal that begins with the command's name.
    std::function<void(Workspace&, const Arguments&)> apply{};
    /// Finishes at once the work that apply() starts and ticks continue (Lab::work), for a script's next
    /// line.
    std::function<void(Workspace&)> finish{};
    std::string lab{};  ///< set by the table; empty: the program's own
};

class CommandTable {
  public:
    void add(Command command);
    void add(const char* name, const char* title, std::vector<Argument> arguments, std::string help,
             Effect effect, std::function<void(Workspace&, const Arguments&)> apply) {
        add({name, title, std::move(arguments), std::move(help), effect, std::move(apply)});
    }
    /// Commands added from here on belong to that lab.
    void begin_lab(std::string name) { lab_ = std::move(name); }
    const Command* find(std::string_view name) const;
    const std::vector<Command>& all() const { return commands_; }

    /// Checks the arguments and applies the command. Throws Refused (or UnknownCommand) and leaves the
    /// workspace unchanged. `gesture` merges the undo entries of one drag.
    void run(Workspace& workspace, std::string_view name, const Json& arguments, Gesture gesture = 0) const;

  private:
    std::vector<Command> commands_;
    std::string lab_;
};

/// The check that CommandTable::run makes first. Throws Refused.
void check_arguments(const Command& command, const Json& given);

/// "chain.add length [position]", for lists and help.
std::string usage(const Command& command);

/// scene.*, quit.
void add_scene_commands(CommandTable& table);
/// All commands that need no lab: add_scene_commands(), undo, redo, camera.set, time.*, view.*.
void add_workspace_commands(CommandTable& table);

// Checks a value against its argument, and describes in words what the argument accepts.

/// "a number", "a point [x, y, z]"
std::string type_text(ArgumentType type);
/// With range and choices: "a number, 0 to 1", "one of dark, light".
std::string rule_text(const Argument& argument);

/// Throws Refused if the value does not fit. The message begins with `where`: "chain.add: length".
void check_value(const Argument& argument, const Json& value, const std::string& where);

}  // namespace tendril::app
