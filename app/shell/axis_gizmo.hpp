// Which way one looks: the axes in the corner of the view. A click on one looks along it.
#pragma once

#include "app/shell/shell.hpp"

namespace tendril::app {

/// Nothing where the view is too small for it.
void show_axis_gizmo(const ShellFrame& frame, Emit& emit);

}  // namespace tendril::app
