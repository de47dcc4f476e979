// The pieces that the Rope lab's panels are put together from.
#pragma once

#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// Buttons that add ropes, cloths, hair and colliders.
void adding_rows(const Workspace& workspace, Emit& emit);
/// How well lengths hold.
Verdict rope_verdict(const RopePart& part);
/// What is selected, and what can be done to it.
void selection_rows(const Workspace& workspace, Emit& emit);
/// How the simulation goes: numbers, and curves of the last ten seconds.
void number_rows(const Workspace& workspace, const Palette& palette);

}  // namespace tendril::app
