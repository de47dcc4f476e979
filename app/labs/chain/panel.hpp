// The rows that the Chain lab's panel and inspector are put together from.
#pragma once

#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/kit/panel_rows.hpp"

namespace tendril::app {

/// At the right of the item before: what a mode does, as a small picture.
void draw_mode(ChainMode mode, const Palette& colours);
/// The panel: what solves, and its options.
void solver_rows(const ChainPart& part, Emit& emit);
/// The panel: microscope and race.
void study_rows(const ChainPart& part, Emit& emit);
/// The panel: what to copy.
void export_rows(Emit& emit);
/// The inspector: what became of the last move of the target, and how the last solve went.
void report_rows(const ShownChain& shown, const std::vector<glm::vec3>& joints, const Palette& palette);
/// The inspector: what is selected.
void selection_rows(const ShownChain& shown, const std::vector<glm::vec3>& joints, Emit& emit);
/// The length of the selected joints' bones.
void length_field(const char* name, const ChainPart& part, Emit& emit);
/// The inspector: the limit of the selected joints.
void limit_rows(const ChainPart& part, Emit& emit);
/// The inspector: the step that the microscope shows.
void microscope_rows(const ShownChain& shown, const Palette& palette, Emit& emit);
/// The inspector: who takes part in the race, and how they do.
void race_rows(const ShownChain& shown, const Palette& palette, Emit& emit);

// What became of the last move of the target, in a few words: the first thing one reads.

/// "Reached", "Out of reach: 0.23 m short", "Limited by joint 1: 0.10 m short".
Verdict chain_verdict(const ChainPart& part);

}  // namespace tendril::app
