// How time changes the part of a lab.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "app/document/workspace.hpp"

namespace tendril::app {

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
