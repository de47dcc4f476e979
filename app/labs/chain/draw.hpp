// Draws the Chain lab's scene.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/vec3.hpp>
#include <tendril/ik/method.hpp>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

// The displayed chain: its present pose or, under the microscope, the pose at a step of the solve. Scene,
// inspector and --state use these functions, so they all show the same step.

/// The lab's part and the result of its study. Refers to the workspace: do not store.
struct ShownChain : Studied {
    const ChainPart& part;

    /// The step of the solve, or the iteration of the race.
    std::size_t step() const { return std::min(part.study.step, last()); }
};
ShownChain shown_chain(const Workspace& workspace);

/// One position for each joint, metres.
std::vector<glm::vec3> shown_joints(const ShownChain& shown);

/// True if the displayed pose is the end of the last solve, not a step on the way.
bool shows_end(const ShownChain& shown);

/// The active limit if the end of the solve is shown; otherwise null.
const ik::ActiveLimit* shown_active_limit(const ShownChain& shown);

/// A segment's readings for the joints at `joints`.
struct ShownSegment {
    glm::vec3 position{0.0f};
    float length = 0.0f;  ///< metres: its bone's displayed length, which may vary during a solve; for the
                          ///< root, its stored length
    float error = 0.0f;   ///< metres, difference from the stored length
};
ShownSegment shown_segment(const ShownChain& shown, const std::vector<glm::vec3>& joints, std::size_t index);

/// The maximum error of all segments, metres.
float worst_error(const ShownChain& shown, const std::vector<glm::vec3>& joints);

/// "root" and "tip" in modes Reach and Curve, "head" and "tail" in trailing modes; empty for joints between.
const char* end_name(const ChainPart& part, std::size_t index);

/// Metres from the tip to the target, in the plane if there is one; 0 for an empty chain.
float shown_residual(const ChainPart& part, const std::vector<glm::vec3>& joints);

/// Draws mode Curve's curve and control points and, if curve_frames() says so, the bones' frames.
void draw_curve(const View& view, const ChainPart& part, DrawList& list);
LabSetting curve_frames();
/// Draws segments as lines and spheres, or as bones.
LabSetting segment_style();
/// In mode Reach: shows or hides the sphere within the chain's reach.
LabSetting reach_sphere();

/// A circle of short lines; `across` and `up` are perpendicular unit vectors, `pixels` is the line width.
void draw_circle(DrawList& list, glm::vec3 centre, float radius, glm::vec3 across, glm::vec3 up, float pixels,
                 glm::vec4 colour);

/// The joint limits as the solver uses them, and the present joint angles.
void draw_limits(const View& view, const ShownChain& shown, DrawList& list);
/// Draws the microscope's step over the poses at the ends of earlier iterations.
void draw_microscope(const View& view, const ShownChain& shown, DrawList& list);
/// Draws the poses of a race at its iteration: side by side only this pane's, otherwise all, spread apart
/// where they overlap.
void draw_race(const View& view, const ShownChain& shown, DrawList& list);
/// One pane for each solver of a side-by-side race; otherwise none.
std::vector<PaneTitle> race_panes(const ShownChain& shown, const Palette& palette);

/// Drawn under a chain that shows the state after an incident: the pose before, and the joint's jump.
void draw_incident(const View& view, const ChainPart& part, DrawList& list);

// Colours used only in this lab; the others are in view/palette.hpp.

/// The curve's colour too: pole target and curve both show which way the chain bends.
glm::vec3 pole_colour(const Palette& palette);
/// The colour of a solver in a race; solvers also differ in lightness.
glm::vec3 solver_colour(const Palette& palette, ik::Method method);

}  // namespace tendril::app
