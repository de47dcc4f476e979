// Joint limits in the panel and in the view: an adult's range, overlaid with the range that the clips use.
#pragma once

#include <tendril/humanoid/bone_map.hpp>
#include <vector>

#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

glm::vec3 adult_colour(const Palette& palette);
glm::vec3 clips_colour(const Palette& palette);

/// As set in the view: the active joint in full; other selected joints as outlines with their current
/// rotation; all other joints as outlines. Joints held back by their limits show only those.
void draw_limits(const View& view, DrawList& list, const HumanoidPart& part, const ShownPose& shown);
/// Legend of the limit colours; empty if none are drawn.
std::vector<LegendRow> limits_legend(const Workspace& workspace);

}  // namespace tendril::app
