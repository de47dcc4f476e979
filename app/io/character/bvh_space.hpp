// What a BVH file leaves open: which axis points up, whether a root's positions replace its OFFSET or are
// added to it, how long its unit is, and how the figure stands when it does not move. All of it is judged by
// the zero pose and the motion together, if legs and a head are found; without them Y is up, positions
// replace the OFFSET, and only the unit is guessed.
#pragma once

#include <vector>

#include "app/io/character/character.hpp"

namespace tendril::app {

/// `nodes` rest in the zero pose, at their OFFSETs. `character` has the motion and the root offsets in the
/// file's units and axes, with the roots' positions as they stand there. Sets the scale, the space and the
/// skeleton, converts the motion, and says what was guessed.
void judge_space(Character& character, std::vector<humanoid::Node> nodes);

}  // namespace tendril::app
