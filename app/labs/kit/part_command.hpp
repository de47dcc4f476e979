// How a command changes the part of a lab.
#pragma once

#include <utility>
#include <vector>

#include "app/document/command.hpp"

namespace tendril::app {

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

}  // namespace tendril::app
