// The ground that the character walks on, where it is more than the level one that the picture has anyway.
#pragma once

#include "app/labs/humanoid/ik/ground_setting.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

/// A piece of it around a point, whose height does not matter.
void draw_ground(const View& view, DrawList& list, const GroundSetting& ground, glm::vec3 around);

}  // namespace tendril::app
