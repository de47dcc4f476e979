// Dragging a joint in Reach: the joint is an effector of its own for as long as it is dragged.
//
// The dragged joint comes first: the bones between the root and it are solved for the point that it is
// dragged to. The bones beyond it then reach from there for the target, as far as they can. So an elbow that
// is dragged swings while the hand keeps hold of the target, as under an IK goal in Blender or an IK handle
// in Maya; and dragging it back puts the tip back too, which bones that only went along stiffly would not do.
// The root and the target stay. The tip, dragged, leaves the target; the root, dragged, takes the whole chain
// along before that reaches for the target again. Joint limits hold throughout. The pole target pulls only
// where the whole chain is solved (root and tip): it says where the bend of the whole chain faces, and would
// fight the hand for any joint between.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <tendril/chain/chain.hpp>

#include "app/labs/chain/reach.hpp"

namespace tendril::app {

/// Metres. Throws std::out_of_range for a bad index, std::invalid_argument where the solver refuses.
void drag_joint(Chain& chain, ReachSettings& settings, std::size_t index, glm::vec3 to, glm::vec3 target,
                ChainRuntime& runtime);

}  // namespace tendril::app
