// The panel's rows about time: walks, the clip, the frame rates.
#pragma once

#include "app/document/workspace.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// The paths that controls follow; draws nothing if no control can follow one.
void walk_rows(const Workspace& workspace, Emit& emit);
/// The clip, the frame rates, plots of the last ten seconds, and the flip rule.
void time_rows(const Workspace& workspace, Emit& emit);

}  // namespace tendril::app
