// Dragging joints in Reach: each is an effector of its own for as long as it is dragged.
//
// The dragged joint comes first: the bones between the root and it are solved for the point that it is
// dragged to. The bones beyond it then reach from there for the target, as far as they can. So an elbow that
// is dragged swings while the hand keeps hold of the target, as under an IK goal in Blender or an IK handle
// in Maya; and dragging it back puts the tip back too, which bones that only went along stiffly would not do.
// The root and the target stay. The tip, dragged, leaves the target; the root, dragged, takes the whole chain
// along before that reaches for the target again. Several that are dragged come one after the other, from the
// root out: the bones between two of them are solved from where the first one got to. Joint limits hold
// throughout. The pole target pulls only
// where the whole chain is solved (root and tip): it says where the bend of the whole chain faces, and would
// fight the hand for any joint between.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <tendril/chain/chain.hpp>

#include "app/labs/chain/reach.hpp"

namespace tendril::app {

struct JointPull {
    std::size_t joint = 0;
    glm::vec3 to{0.0f};  ///< metres
};

/// `pulls`: one at least, ascending, each joint once and there. Throws std::invalid_argument where the solver
/// refuses.
void drag_joints(Chain& chain, ReachSettings& settings, std::span<const JointPull> pulls, glm::vec3 target,
                 ChainRuntime& runtime);

/// In the modes in which a chain trails: the first of the joints goes where it is pulled, the others as near
/// as the bones between them let them, and both ends trail. Refuses what Chain::with_index does.
Result trail_joints(Chain& chain, std::span<const JointPull> pulls);

}  // namespace tendril::app
