// How far joints may turn, in the picture: an adult's range, and over it the one that the clips really use.
#pragma once

#include <tendril/humanoid/bone_map.hpp>
#include <vector>

#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

glm::vec3 adult_colour(const Palette& palette);
glm::vec3 clips_colour(const Palette& palette);

/// As the view asks for: the active joint's in full, the other selected ones' as outlines with where they are
/// now, all others' as an outline, and of those that hold the body back only what holds them.
void draw_limits(const View& view, DrawList& list, const HumanoidPart& part, const ShownPose& shown);
/// What the colours of that mean; nothing where nothing is drawn.
std::vector<LegendRow> limits_legend(const Workspace& workspace);

}  // namespace tendril::app
