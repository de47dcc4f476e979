// The panel's rows about time: what walks, the clip, the frame rates.
#pragma once

#include "app/document/workspace.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// What moves a control by itself; nothing where no control can.
void walk_rows(const Workspace& workspace, Emit& emit);
/// Clip, frame rates, what of the last ten seconds is shown, and what counts as a flip.
void time_rows(const Workspace& workspace, Emit& emit);

}  // namespace tendril::app
