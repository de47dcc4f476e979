// Rows of the Chain lab's panel and inspector, and the remedies that they offer.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "app/document/incident.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/labs/kit/panel_rows.hpp"

namespace tendril::app {

/// A small sketch of a mode beside the last item, right-aligned, `short_of` pixels from the edge.
void draw_mode(ChainMode mode, const Palette& colours, float short_of, float scale);
/// Panel: the solver and its options.
void solver_rows(const ChainPart& part, MoreRows& more, Emit& emit);
/// Panel: a button that opens a preset, `of` in its row.
void preset_button(const Preset& preset, int of, Emit& emit);
/// Panel: the curve of mode Curve.
void curve_rows(const ChainPart& part, MoreRows& more, Emit& emit);
/// Panel: microscope and race.
void study_rows(const ChainPart& part, Emit& emit);
/// Panel: copying.
void export_rows(Emit& emit);
/// Inspector: the outcome of the last move of the target, and the report of the last solve.
void report_rows(const ShownChain& shown, const std::vector<glm::vec3>& joints, const Palette& palette,
                 Emit& emit);
/// Inspector, in mode Curve: how the chain fits the curve.
void curve_report_rows(const ChainPart& part, const Palette& palette, Emit& emit);
/// Inspector: the selected control points; at least one.
void control_rows(const ChainPart& part, Emit& emit);
/// Moves control points, and stops the target's motion if it would undo that.
void emit_points(const ChainPart& part, std::vector<glm::vec3> points, Emit& emit);
/// Inspector: the selection.
void selection_rows(const ShownChain& shown, const std::vector<glm::vec3>& joints, Emit& emit);
/// The bone length of the selected joints.
void length_field(const char* name, const ChainPart& part, Emit& emit);
/// Inspector: the limit of the selected joints; `pose`: the joints as shown.
void limit_rows(const ChainPart& part, const std::vector<glm::vec3>& pose, Emit& emit);
/// Inspector: the microscope's step.
void microscope_rows(const ShownChain& shown, const Palette& palette, Emit& emit);
/// Inspector: the solvers of the race and their results.
void race_rows(const ShownChain& shown, const Palette& palette, Emit& emit);
/// Each solver's tip to target after each iteration, or against time.
void race_plot(const ShownChain& shown, bool time, const Palette& palette);

/// The outcome of a move: "Reached", "Out of reach: 0.23 m short", "Limited: 0.10 m short".
Verdict chain_verdict(const ChainPart& part);
Verdict curve_verdict(const ChainPart& part);
/// "0.23 m", or "4.1 mm" if small.
std::string distance_text(float metres);
/// The meaning of the last solve's status, with what may help, in sentences.
std::string status_text(const ChainPart& part);

// Remedies for a chain that stalls or flips, as commands for a button.

/// The initial pole target: beside the middle of the line from head to tail, on the side to which the chain
/// bends, so that adding it rotates nothing. Above a straight chain.
glm::vec3 first_pole(const ChainPart& part);

/// True if all joints lie on the line from the root to the target.
bool in_line_with_target(const ChainPart& part);

/// The remedy for a solve that ended short of a target within reach, if there is one.
std::optional<Cure> reach_cure(const ChainPart& part);

/// The remedy for a flip between two ticks, if there is one.
std::optional<Cure> flip_cure(FlipCure cure, const ChainPart& before, const ChainPart& after);

}  // namespace tendril::app
