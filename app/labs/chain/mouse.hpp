// Dragging joints. In mode Reach, each dragged joint is an effector of its own.
//
// The bones from the root to the dragged joint are solved for the drag point; the bones beyond it then reach
// for the target. So dragging an elbow swings it while the hand keeps hold of the target, as under an IK goal
// in Blender or an IK handle in Maya, and dragging it back restores the tip, which bones that merely moved
// along stiffly would not do. Root and target stay. Dragging the tip leaves the target; dragging the root
// moves the whole chain along before it reaches for the target again. Several dragged joints are solved from
// the root outwards, each section from where the one before it ended. Joint limits always hold. The pole
// target acts only when the whole chain is solved (root and tip): it sets where the bend of the whole chain
// faces, and would fight the hand at any joint between.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <tendril/chain/chain.hpp>

#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/reach.hpp"

namespace tendril::app {

struct JointPull {
    std::size_t joint = 0;
    glm::vec3 to{0.0f};  ///< metres
};

/// `pulls`: at least one, in ascending order of existing joints without duplicates. Throws
/// std::invalid_argument if the solver refuses.
void drag_joints(Chain& chain, ReachSettings& settings, std::span<const JointPull> pulls, glm::vec3 target,
                 ChainRuntime& runtime);

/// For the trailing modes: the first joint goes where it is pulled, the others get as near as the bones
/// between allow, and both ends trail. Refuses the same input as Chain::with_index.
Result trail_joints(Chain& chain, std::span<const JointPull> pulls);

/// The handle of a limit's end in the plane; none if there is no such limit, or it is fixed at present.
std::optional<Handle> limit_handle(const ChainPart& part, const LimitEnd& end);

}  // namespace tendril::app
