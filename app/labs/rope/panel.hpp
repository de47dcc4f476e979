// The sections that make up the panels of the Rope lab.
#pragma once

#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// Buttons that add ropes, cloths, hair and colliders.
void adding_rows(const Workspace& workspace, Emit& emit);
/// How well lengths are kept.
Verdict rope_verdict(const RopePart& part);
/// Of a selected tie.
void tie_rows(const RopePart& part, const rope::Tie& tie, Emit& emit);
/// The selection, and actions on it.
void selection_rows(const Workspace& workspace, Emit& emit);
/// Simulation statistics, and curves of the last ten seconds.
void number_rows(const Workspace& workspace, const Palette& palette, Emit& emit);

}  // namespace tendril::app
