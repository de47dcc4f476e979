// Sections of a panel that fold to their title, and stay as one left them.
#pragma once

#include "app/document/workspace.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// A heading that folds what follows, by a click anywhere on it. Whether to show that. It is kept in the
/// settings, by the names of the lab and of the section.
[[nodiscard]] bool folding_section(const Workspace& workspace, const char* title, Emit& emit,
                                   bool open_at_first = true);

}  // namespace tendril::app
