// The paths that controls of the Rig lab follow.
#pragma once

#include "app/labs/lab.hpp"

namespace tendril::app {

void draw_walks(const View& view, DrawList& list);

}  // namespace tendril::app
