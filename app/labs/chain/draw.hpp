// What the Chain lab's picture is drawn with.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/shown.hpp"

namespace tendril::app {

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

}  // namespace tendril::app
