// Arguments and helpers that the commands of every lab share.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <tendril/result.hpp>
#include <utility>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/command.hpp"
#include "app/document/workspace.hpp"
#include "app/io/json_place.hpp"
#include "app/io/names.hpp"

namespace tendril::app {

// Turns a library error into an exception with a message for the user.

/// Throws std::invalid_argument with the result's reason if it is an error.
inline void require_ok(const Result& result) {
    if (!result) throw std::invalid_argument(result.reason());
}

/// The value. Throws std::invalid_argument with the error's reason if there is none.
template <class T>
T require_value(Expected<T> expected) {
    if (!expected) throw std::invalid_argument(expected.reason());
    return std::move(expected).value();
}

// Commands that act on several items at once: a list of indices, and parallel lists of values.

/// Optional. `instead_of` names the single-item argument that it replaces.
Argument index_list_argument(const char* name, const char* instead_of);
/// The text; empty if it is not given.
std::string text_or_none(const Arguments& given, const char* name);
/// True if the index is given, false if the list is. Throws Refused if both or neither are.
bool gives_one(const Arguments& given, const char* index, const char* list);
/// The indices. Throws Refused, naming argument and value, for anything but an integer in [0, `count`).
std::vector<std::size_t> index_list(const Arguments& given, const char* name, std::size_t count);

/// An optional list with one value for each entry of the list argument `of`.
Argument each_argument(const char* name, const char* of);
/// Throws, naming the argument, if `of` is missing or the list does not have `count` values.
JsonPlace each_list(const Arguments& given, const char* name, const char* of, std::size_t count);

// The same for items with names; gives_one() serves both.

/// Optional. `instead_of` names the single-item argument that it replaces; `more` is appended to the help.
Argument name_list_argument(const char* name, const char* instead_of, const char* more = "");
/// The names. Throws Refused, naming the argument and the value, for anything but a string.
std::vector<std::string> name_list(const Arguments& given, const char* name);

/// The inverse of gives_one() and name_list(): one name, or the list.
NamedArgument one_or_list(const char* one, const char* list, const std::vector<std::string>& names);

/// "Head, LeftHand"; names after the eighth are counted: "and 3 more".
std::string name_list_text(const std::vector<std::string>& names);

// Changing a lab's part from a command.

/// Edits a copy of the lab's part: `change` receives the copy and the old part. If both end up equal, there
/// is no undo step. If `change` throws, the document is unchanged (see CommandTable::run).
template <class LabPart, class Change>
void change_part(Workspace& workspace, const char* lab, Change change) {
    const Document before = workspace.document;
    LabPart& part = workspace.document.edit<LabPart>(lab);
    const LabPart& old = before.get<LabPart>(lab);
    change(part, old);
    if (part == old) workspace.document = before;
}

/// A command that calls `change` through change_part(): with the workspace, for its clock and the lab's
/// runtime, the copy, the old part and the arguments.
template <class LabPart, class Change>
Command part_command(const char* lab, const char* name, const char* title, std::vector<Argument> arguments,
                     const char* help, Effect effect, Change change) {
    return {.name = name,
            .title = title,
            .arguments = std::move(arguments),
            .help = help,
            .effect = effect,
            .apply = [lab, change](Workspace& workspace, const Arguments& given) {
                change_part<LabPart>(workspace, lab, [&](LabPart& part, const LabPart& before) {
                    change(workspace, part, before, given);
                });
            }};
}
/// The same for a change that needs only the part and the arguments.
template <class LabPart>
Command part_command(const char* lab, const char* name, const char* title, std::vector<Argument> arguments,
                     const char* help, void (*change)(LabPart&, const Arguments&),
                     Effect effect = Effect::Edit) {
    return part_command<LabPart>(
        lab, name, title, std::move(arguments), help, effect,
        [change](Workspace&, LabPart& part, const LabPart&, const Arguments& given) { change(part, given); });
}

// Advancing a lab's part in time.

/// Applies `advance` to a copy of the lab's part. If it throws std::logic_error, because a value left the
/// range that a scene can hold, restores the document and returns the message.
template <class LabPart, class Advance>
std::optional<std::string> guarded_step(Workspace& workspace, const char* lab, Advance advance) {
    const Document before = workspace.document;
    try {
        advance(workspace.document.edit<LabPart>(lab));
        return std::nullopt;
    } catch (const std::logic_error& error) {
        workspace.document = before;
        return error.what();
    }
}

}  // namespace tendril::app
