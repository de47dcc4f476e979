#include "app/document/command.hpp"

#include <algorithm>
#include <cmath>

#include "app/document/refused.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"

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

/// A lab that could not be read keeps its JSON of the scene's file until it is edited; then saving asks.
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

/// "2", "0.05": a limit declared as a float, without its rounding digits.
std::string plain(double value) {
    const auto single = static_cast<float>(value);
    std::string text = Json(static_cast<double>(single) == value ? shortest_decimal(single) : value).dump();
    if (text.ends_with(".0")) text.erase(text.size() - 2);
    return text;
}

/// A finite number of at most 1e9 in magnitude: required of all input.
bool sane(const Json& value) {
    if (!value.is_number()) return false;
    const double number = value.get<double>();
    return std::isfinite(number) && std::abs(number) <= 1e9;
}

void check_point(const Json& value, ArgumentType type, const auto& refuse) {
    if (!value.is_array() || value.size() != 3) refuse(type_text(type));
    for (const auto& coordinate : value) {
        if (!sane(coordinate)) refuse("three finite numbers of at most 1e9 in magnitude");
    }
}

/// True if the coordinates have unit length, within the rounding of hand-written decimals.
bool is_unit(const Json& value) {
    double squares = 0.0;
    for (const auto& coordinate : value) {
        if (!sane(coordinate)) return false;
        squares += coordinate.get<double>() * coordinate.get<double>();
    }
    return std::abs(std::sqrt(squares) - 1.0) < 1e-3;
}

/// "0 to 1", "at least 3"; empty if any number is allowed.
std::string range_text(const Argument& argument) {
    const auto bound = [&](double limit) {
        const bool whole = argument.type == ArgumentType::Integer;
        return whole ? std::to_string(static_cast<long long>(limit)) : plain(limit);
    };
    const bool any_low = argument.low <= -1e9, any_high = argument.high >= 1e9;
    if (any_low && any_high) return "";
    return any_low    ? "at most " + bound(argument.high)
           : any_high ? "at least " + bound(argument.low)
                      : bound(argument.low) + " to " + bound(argument.high);
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
        if (beginnings == workspace.beginnings) {  // otherwise the command set up the history itself
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

std::string type_text(ArgumentType type) {
    switch (type) {
        case ArgumentType::Number:
            return "a number";
        case ArgumentType::Integer:
            return "a whole number";
        case ArgumentType::Boolean:
            return "true or false";
        case ArgumentType::Text:
            return "text";
        case ArgumentType::Point:
            return "a point [x, y, z]";
        case ArgumentType::NumberOrPoint:
            return "a number or a point [x, y, z]";
        case ArgumentType::Rotation:
            return "a unit quaternion [x, y, z, w] or angles in degrees [x, y, z]";
        case ArgumentType::List:
            return "a list";
        case ArgumentType::ListOrText:
            return "a list or text";
        case ArgumentType::Any:
            return "a value";
    }
    return "";
}

void check_value(const Argument& argument, const Json& value, const std::string& where) {
    const auto refuse = [&](const std::string& rule) {
        throw Refused(where + " must be " + rule + ", got " + json_summary(value));
    };
    switch (argument.type) {
        case ArgumentType::Boolean:
            if (!value.is_boolean()) refuse(type_text(argument.type));
            return;
        case ArgumentType::Text:
            if (!value.is_string()) refuse(type_text(argument.type));
            // Paths may hold any bytes.
            if (argument.name != "path" && !is_storable(value.get_ref<const std::string&>()))
                refuse("text in UTF-8, without U+FFFD");
            if (!argument.choices.empty() && std::find(argument.choices.begin(), argument.choices.end(),
                                                       value.get<std::string>()) == argument.choices.end()) {
                refuse("one of " + comma_list(argument.choices));
            }
            return;
        case ArgumentType::NumberOrPoint:
            if (value.is_array()) {
                check_point(value, argument.type, refuse);
                return;
            }
            [[fallthrough]];
        case ArgumentType::Number:
            if (!value.is_number()) refuse(type_text(argument.type));
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
                refuse(type_text(argument.type));
            return;
        case ArgumentType::Any:
            return;
        case ArgumentType::Integer:
            if (!value.is_number()) refuse(type_text(argument.type));
            if (!std::isfinite(value.get<double>()) ||
                std::trunc(value.get<double>()) != value.get<double>()) {
                refuse(type_text(argument.type));
            }
            break;
    }
    const double number = value.get<double>();
    if (number < argument.low || number > argument.high) refuse(range_text(argument));
}

std::string rule_text(const Argument& argument) {
    if (!argument.choices.empty()) return "one of " + comma_list(argument.choices);
    const std::string range = range_text(argument);
    return type_text(argument.type) + (range.empty() ? range : ", " + range);
}

}  // namespace tendril::app
