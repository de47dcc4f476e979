// The arguments that the commands of every lab are put together from.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <tendril/result.hpp>
#include <utility>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/command.hpp"
#include "app/document/json_place.hpp"
#include "app/document/names.hpp"
#include "app/document/workspace.hpp"

namespace tendril::app {

Argument choice_argument(const char* name, bool required, const char* help, std::vector<std::string> choices);
// These may be left out.
Argument integer_argument(const char* name, const char* help, double low, double high);
Argument number_argument(const char* name, const char* help, double low, double high);
Argument switch_argument(const char* name, const char* help);
// These may be left out where not `required`.
Argument text_argument(const char* name, bool required, const char* help);
Argument point_argument(const char* name, bool required, const char* help);
/// One of `count` things that are counted from 0.
Argument index_argument(const char* name, bool required, const char* help, std::size_t count);
/// The same argument, for which the palette offers what is there to be named.
Argument offering(Argument argument, std::function<std::vector<std::string>(const Workspace&)> known);
/// "0", "1", ... to before `count`: for things that are counted.
std::vector<std::string> places(std::size_t count);

// A refusal of the library becomes one of the program: the message is what the person reads.

/// Throws std::invalid_argument with the result's message, unless all is fine.
inline void require_ok(const Result& result) {
    if (!result) throw std::invalid_argument(result.message());
}

/// The value, or std::invalid_argument with the message that says why there is none.
template <class T>
T require_value(Expected<T> expected) {
    if (!expected) throw std::invalid_argument(expected.message());
    return std::move(expected).value();
}

// Several of many things, for a command that does the same to all: a list of indices, counted from 0; and
// what is not the same for all, another list.

/// May be left out: `instead_of` names the one that is given then.
Argument index_list_argument(const char* name, const char* instead_of);
/// Whether one is given by its index, and not several by a list. Throws Refused where it is neither or both.
bool gives_one(const Arguments& given, const char* index, const char* list);
/// As they are given. Throws Refused, with the argument and the value, for what is no whole number below
/// `count`.
std::vector<std::size_t> index_list(const Arguments& given, const char* name, std::size_t count);

/// A list of values, one for each of the list that is called `of`. May be left out.
Argument each_argument(const char* name, const char* of);
/// Throws, with the argument, unless the list has `count` values.
JsonPlace each_list(const Arguments& given, const char* name, const char* of, std::size_t count);

// Several things that have names, for a command that does the same to all. gives_one() of index_list.hpp
// says whether one is given, or several.

/// May be left out: `instead_of` names the one that is given then. `more` is said of it in addition.
Argument name_list_argument(const char* name, const char* instead_of, const char* more = "");
/// As they are given. Throws Refused, with the argument and the value, for what is no text.
std::vector<std::string> name_list(const Arguments& given, const char* name);

/// "Head, LeftHand": of many names only the first, and dots.
std::string name_list_text(const std::vector<std::string>& names);

// How a command changes the part of a lab.

/// Changes a copy of the lab's part: `change` gets it, and the part as it was. A change that comes out equal
/// is none, and leaves no step to undo; what `change` throws leaves the document as it was (see
/// CommandTable::run).
template <class LabPart, class Change>
void change_part(Workspace& workspace, const char* lab, Change change) {
    const Document before = workspace.document;
    LabPart& part = workspace.document.edit<LabPart>(lab);
    const LabPart& old = before.get<LabPart>(lab);
    change(part, old);
    if (part == old) workspace.document = before;
}

/// A command that does just that.
template <class LabPart>
Command part_command(const char* lab, const char* name, const char* title, std::vector<Argument> arguments,
                     const char* help, void (*change)(LabPart&, const Arguments&),
                     Effect effect = Effect::Edit) {
    return {.name = name,
            .title = title,
            .arguments = std::move(arguments),
            .help = help,
            .effect = effect,
            .apply = [lab, change](Workspace& workspace, const Arguments& given) {
                change_part<LabPart>(workspace, lab,
                                     [&](LabPart& part, const LabPart&) { change(part, given); });
            }};
}

// How time changes the part of a lab.

/// Lets `advance` change a copy of the lab's part. Where it throws std::logic_error, since something left the
/// range that a scene can hold, the document stays as it was and the reason is given back.
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
