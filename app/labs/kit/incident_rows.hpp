// The section of an inspector that lists what happened in the last ten seconds.
#pragma once

#include "app/document/workspace.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// The last flips and what else happened; a click goes to it. Nothing where there are none.
void incident_rows(const Workspace& workspace, const Palette& palette, Emit& emit);

}  // namespace tendril::app
