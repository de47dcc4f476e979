#include "app/document/command.hpp"

#include <algorithm>

#include "app/document/argument_check.hpp"
#include "app/document/json_complete.hpp"

namespace tendril::app {
namespace {

/// Pushes an undo entry that shows the lab whose part changed, even if another lab is open.
void remember(Workspace& workspace, const Document& changed, const Command& command, Gesture gesture,
              Place from) {
    Place to = workspace.place();
    if (from.lab == to.lab && changed.parts().size() == 1 && changed.parts().begin()->first != to.lab) {
        from.lab = to.lab = changed.parts().begin()->first;
        from.camera = to.camera = std::nullopt;
    }
    workspace.history.push(changed, command.name, gesture, from, to);
}

/// What the scene's file has of a lab that could not be read is saved again until the lab is edited; from
/// then on saving asks.
void replace_unread(Workspace& workspace, const Document& before) {
    const Document edited_document = workspace.document;
    for (const auto& [lab, part] : edited_document.parts()) {
        const auto was = before.parts().find(lab);
        if (was == before.parts().end() || was->second == part || !was->second->unread) continue;
        const std::shared_ptr<Part> edited = part->clone();
        edited->unread = was->second->unread;
        edited->unread_why = was->second->unread_why;
        edited->replaces_unread = true;
        edited->unread_stand_in = nullptr;
        workspace.document.set(lab, edited);
    }
}

}  // namespace

void check_arguments(const Command& command, const Json& given) {
    if (!given.is_object() && !given.is_null()) {
        throw Refused(command.name, "arguments must be an object, got " + json_summary(given));
    }
    for (const auto& [name, value] : given.items()) {
        const auto known = std::find_if(command.arguments.begin(), command.arguments.end(),
                                        [&key = name](const Argument& a) { return a.name == key; });
        if (known == command.arguments.end()) {
            throw Refused(command.name, "unknown argument \"" + name + "\"; it takes: " + usage(command));
        }
        check_value(*known, value, command.name + ": " + name);
    }
    for (const auto& argument : command.arguments) {
        if (argument.required && !given.contains(argument.name)) {
            throw Refused(command.name, argument.name + " is missing (" + type_text(argument.type) + ")");
        }
    }
}

void CommandTable::add(Command command) {
    if (find(command.name) != nullptr) throw std::logic_error("command added twice: " + command.name);
    command.lab = lab_;
    commands_.push_back(std::move(command));
}

const Command* CommandTable::find(std::string_view name) const {
    const auto found = std::find_if(commands_.begin(), commands_.end(),
                                    [&](const Command& command) { return command.name == name; });
    return found == commands_.end() ? nullptr : &*found;
}

void CommandTable::run(Workspace& workspace, std::string_view name, const Json& arguments,
                       Gesture gesture) const {
    const Command* command = find(name);
    if (command == nullptr) throw UnknownCommand("unknown command \"" + std::string(name) + "\"");
    check_arguments(*command, arguments);

    const Document before = workspace.document;  // copies pointers only: parts are shared
    const Place from = workspace.place();
    workspace.gesture_begins = !workspace.history.is_open(gesture);
    const bool modified = workspace.modified();
    const std::uint64_t beginnings = workspace.beginnings;
    try {
        command->apply(workspace, Arguments(arguments));
    } catch (const std::exception& error) {
        workspace.document = before;
        throw Refused(command->name, reason_of(error));
    }
    // A new file path counts as a change too: undo restores the old one.
    if (workspace.document == before && workspace.path == from.path) return;
    if (command->effect == Effect::Replace) return;
    if (command->effect == Effect::Edit) {
        if (beginnings == workspace.beginnings) {  // else the command has made the past itself
            replace_unread(workspace, before);
            const auto& part = before.parts().at(workspace.lab);
            workspace.discard_later(part);
            if (part != workspace.document.parts().at(workspace.lab))
                workspace.rewind.begin_change(workspace.edition, part);
            workspace.ui.incident.reset();
        }
        workspace.begin_edition();
        workspace.clock.replaying = false;
        remember(workspace, before.without(workspace.document), *command, gesture, from);
    } else if (!modified) {
        workspace.saved = workspace.document;  // selection does not mark the scene as modified
    }
}

std::string usage(const Command& command) {
    std::string text = command.name;
    for (const auto& argument : command.arguments) {
        text += argument.required ? " " + argument.name : " [" + argument.name + "]";
    }
    return text;
}

}  // namespace tendril::app
