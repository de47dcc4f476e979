// What the Chain lab's picture is drawn with.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <tendril/ik/method.hpp>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

// The chain as the picture has it: where it is or, under the microscope, where a step of the solve has it.
// Picture, inspector and --state all ask here, so that they show the same step.

/// The lab's part of a workspace, with what its study came to. Refers to the workspace: not to be kept.
struct ShownChain {
    const ChainPart& part;
    std::shared_ptr<const Trace> trace;  ///< of the solve under the microscope, else null
    std::shared_ptr<const Race> race;    ///< null while there is none
};
ShownChain shown_chain(const Workspace& workspace);

/// One a joint, metres.
std::vector<glm::vec3> shown_joints(const ShownChain& shown);

/// Whether it is where the last solve ended, and not a step on the way there.
bool shows_end(const ShownChain& shown);

/// The joint that stops the chain, while the chain is shown where it was stopped; null where there is none.
const ik::ActiveLimit* shown_active_limit(const ShownChain& shown);

/// What one reads of a segment that is shown at `joints`.
struct ShownSegment {
    glm::vec3 position{0.0f};
    float length = 0.0f;  ///< metres: of its bone as it is shown, which inside a solve may be off; the root
                          ///< has no bone and shows the length that it has stored
    float error = 0.0f;   ///< metres, from the length that the segment should have
};
ShownSegment shown_segment(const ShownChain& shown, const std::vector<glm::vec3>& joints, std::size_t index);

/// The largest error of all, metres.
float worst_error(const ShownChain& shown, const std::vector<glm::vec3>& joints);

/// "root" and "tip" of a chain that reaches, "head" and "tail" of one that trails; empty between the two.
const char* end_name(const ChainPart& part, std::size_t index);

/// Metres from the tip to the target; 0 for an empty chain.
float shown_residual(const ChainPart& part, const std::vector<glm::vec3>& joints);

/// Whether segments are drawn as lines and spheres, or as bones.
LabSetting segment_style();
/// Whether mode reach shows the sphere of what the chain can reach.
LabSetting reach_sphere();

/// A circle of short lines; `across` and `up` are of length 1 and at right angles. `pixels`: their width.
void draw_circle(DrawList& list, glm::vec3 centre, float radius, glm::vec3 across, glm::vec3 up, float pixels,
                 glm::vec4 colour);

/// The limits, from the numbers that the solver uses, and the angles that the joints have.
void draw_limits(const View& view, const ShownChain& shown, DrawList& list);
/// The pole, and the line that it turns the chain about.
void draw_pole(const View& view, const ChainPart& part, DrawList& list);
/// The sphere of what the chain can reach, as quiet outlines: as the eye sees it, and where it meets the
/// ground.
void draw_reach_sphere(const View& view, const ShownChain& shown, DrawList& list);
/// What the step under the microscope does, over the poses that the iterations before it ended in.
void draw_microscope(const View& view, const ShownChain& shown, DrawList& list);
/// The chains that the solvers of a race ended in: side by side the one of this pane, else all, drawn apart
/// where one would cover another.
void draw_race(const View& view, const ShownChain& shown, DrawList& list);
/// A pane for each solver of a race that is shown side by side, else none.
std::vector<PaneTitle> race_panes(const ShownChain& shown, const Palette& palette);

/// Under a chain that shows what came of an incident: how it stood before, and how the joint that jumped
/// went.
void draw_incident(const View& view, const ChainPart& part, DrawList& list);

// The colours that only this lab needs; view/palette.hpp has the rest.

glm::vec3 pole_colour(const Palette& palette);
/// Of a solver in a race; told apart by lightness too.
glm::vec3 solver_colour(const Palette& palette, ik::Method method);

}  // namespace tendril::app
