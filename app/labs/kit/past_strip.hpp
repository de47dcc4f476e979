// The strip of the last ten seconds below the scene, for a lab that rewinds.
#pragma once

#include "app/document/workspace.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// Nothing, where no moment is remembered.
void past_strip(const Workspace& workspace, Emit& emit);

}  // namespace tendril::app
