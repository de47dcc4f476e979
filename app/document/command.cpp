#include "app/document/command.hpp"

#include <algorithm>
#include <cmath>

#include "app/document/json_complete.hpp"

namespace tendril::app {
namespace {

const char* type_name(ArgumentType type) {
    switch (type) {
        case ArgumentType::Number:
            return "a number";
        case ArgumentType::Integer:
            return "a whole number";
        case ArgumentType::Boolean:
            return "true or false";
        case ArgumentType::Text:
            return "a text";
        case ArgumentType::Point:
            return "a point [x, y, z]";
        case ArgumentType::NumberOrPoint:
            return "a number or a point [x, y, z]";
        case ArgumentType::Rotation:
            return "a unit quaternion [x, y, z, w] or angles in degrees [x, y, z]";
        case ArgumentType::List:
            return "a list";
        case ArgumentType::ListOrText:
            return "a list or a text";
        case ArgumentType::Any:
            return "a value";
    }
    return "";
}

std::string plain(double value) {
    return Json(value).dump();
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

/// Is it a finite number of at most 1e9 in magnitude, as everything that comes in must be?
bool sane(const Json& value) {
    if (!value.is_number()) return false;
    const double number = value.get<double>();
    return std::isfinite(number) && std::abs(number) <= 1e9;
}

void check_point(const Json& value, ArgumentType type, const auto& refuse) {
    if (!value.is_array() || value.size() != 3) refuse(type_name(type));
    for (const auto& coordinate : value) {
        if (!sane(coordinate)) refuse("three finite numbers of at most 1e9 in magnitude");
    }
}

/// Are these four the coordinates of a unit quaternion, but for the rounding of who wrote them down?
bool is_unit(const Json& value) {
    double squares = 0.0;
    for (const auto& coordinate : value) {
        if (!sane(coordinate)) return false;
        squares += coordinate.get<double>() * coordinate.get<double>();
    }
    return std::abs(std::sqrt(squares) - 1.0) < 1e-3;
}

/// Refuses a value that does not fit its argument; `where` is "chain.add: length".
void check_value(const Argument& argument, const Json& value, const std::string& where) {
    const auto refuse = [&](const std::string& rule) {
        throw Refused(where + " must be " + rule + ", got " + json_summary(value));
    };
    switch (argument.type) {
        case ArgumentType::Boolean:
            if (!value.is_boolean()) refuse(type_name(argument.type));
            return;
        case ArgumentType::Text:
            if (!value.is_string()) refuse(type_name(argument.type));
            if (!argument.choices.empty() && std::find(argument.choices.begin(), argument.choices.end(),
                                                       value.get<std::string>()) == argument.choices.end()) {
                refuse("one of " + joined(argument.choices));
            }
            return;
        case ArgumentType::NumberOrPoint:
            if (value.is_array()) {
                check_point(value, argument.type, refuse);
                return;
            }
            [[fallthrough]];
        case ArgumentType::Number:
            if (!value.is_number()) refuse(type_name(argument.type));
            if (!sane(value)) refuse("finite and at most 1e9 in magnitude");
            break;
        case ArgumentType::Point:
            check_point(value, argument.type, refuse);
            return;
        case ArgumentType::Rotation:
            if (value.is_array() && value.size() == 4) {
                if (!is_unit(value)) refuse("a quaternion [x, y, z, w] of length 1");
            } else {
                check_point(value, argument.type, refuse);
            }
            return;
        case ArgumentType::List:
        case ArgumentType::ListOrText:
            if (!value.is_array() && !(argument.type == ArgumentType::ListOrText && value.is_string()))
                refuse(type_name(argument.type));
            return;
        case ArgumentType::Any:
            return;
        case ArgumentType::Integer:
            if (!value.is_number()) refuse(type_name(argument.type));
            if (!std::isfinite(value.get<double>()) ||
                std::trunc(value.get<double>()) != value.get<double>()) {
                refuse(type_name(argument.type));
            }
            break;
    }
    const double number = value.get<double>();
    const auto bound = [&](double limit) {
        const bool whole = argument.type == ArgumentType::Integer;
        return whole ? std::to_string(static_cast<long long>(limit)) : plain(limit);
    };
    if (number >= argument.low && number <= argument.high) return;
    const bool any_low = argument.low <= -1e9, any_high = argument.high >= 1e9;
    refuse(any_low    ? "at most " + bound(argument.high)
           : any_high ? "at least " + bound(argument.low)
                      : bound(argument.low) + " to " + bound(argument.high));
}

void check_arguments(const Command& command, const Json& given) {
    if (!given.is_object() && !given.is_null()) {
        throw Refused(command.name + ": arguments must be an object, got " + json_summary(given));
    }
    for (const auto& [name, value] : given.items()) {
        const auto known = std::find_if(command.arguments.begin(), command.arguments.end(),
                                        [&key = name](const Argument& a) { return a.name == key; });
        if (known == command.arguments.end()) {
            throw Refused(command.name + ": unknown argument \"" + name + "\"; it takes: " + usage(command));
        }
        check_value(*known, value, command.name + ": " + name);
    }
    for (const auto& argument : command.arguments) {
        if (argument.required && !given.contains(argument.name)) {
            throw Refused(command.name + ": " + argument.name + " is missing (" + type_name(argument.type) +
                          ")");
        }
    }
}

/// "chain.remove: index 9 is out of range": the library's messages begin with its own name for the operation,
/// which the command's name already says.
std::string refusal_text(const std::string& command, std::string what) {
    const std::string operation = what.substr(0, what.find(": "));
    if (operation.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") != std::string::npos ||
        operation.size() == what.size())
        return command + ": " + what;
    const std::string own = "_" + command.substr(command.rfind('.') + 1) + "_";
    if (("_" + operation + "_").find(own) != std::string::npos) what.erase(0, operation.size() + 2);
    return command + ": " + what;
}

/// For undo, seen where it happened: in the lab of the part that changed, whichever is open.
void remember(Workspace& workspace, const Document& changed, const Command& command, Gesture gesture,
              Place from) {
    Place to = workspace.place();
    if (from.lab == to.lab && changed.parts().size() == 1 && changed.parts().begin()->first != to.lab) {
        from.lab = to.lab = changed.parts().begin()->first;
        from.camera = to.camera = std::nullopt;
    }
    workspace.history.push(changed, command.name, gesture, from, to);
}

}  // namespace

void CommandTable::add(Command command) {
    if (find(command.name) != nullptr) throw std::logic_error("command added twice: " + command.name);
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

    const Document before = workspace.document;  // parts are shared: a few pointers
    const Place from = workspace.place();
    workspace.gesture_begins = !workspace.history.is_open(gesture);
    const bool modified = workspace.modified();
    const std::uint64_t beginnings = workspace.beginnings;
    try {
        command->apply(workspace, Arguments(arguments));
    } catch (const std::exception& error) {
        workspace.document = before;
        throw Refused(refusal_text(command->name, error.what()));
    }
    // Another file is a change too: undo leads back to the old one.
    if (workspace.document == before && workspace.path == from.path) return;
    if (command->effect == Effect::Replace) return;
    if (command->effect == Effect::Edit) {
        workspace.rewind.forget_from(workspace.moment);  // what came of it, as it was before, came not
        if (const auto& part = before.parts().at(workspace.lab);
            beginnings == workspace.beginnings && part != workspace.document.parts().at(workspace.lab))
            workspace.rewind.begin_change(workspace.edition, part);
        ++workspace.edition;
        workspace.ui.incident.reset();
        workspace.clock.replaying = false;
        remember(workspace, before.without(workspace.document), *command, gesture, from);
    } else if (!modified) {
        workspace.saved = workspace.document;  // choosing something is nothing that wants saving
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
