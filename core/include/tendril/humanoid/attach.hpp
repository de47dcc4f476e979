// Feet of IK rigs that are not children of the legs. Some exported rigs keep their control hierarchy: the
// foot is a child of the root, where the animator moved it as an IK target, and the lower leg has no child.
// Solvers need the foot below the leg:
//
//     for (const LooseFoot& each : loose_feet(skeleton, match_bones(skeleton)))
//         if (each.fits)
//             if (auto moved = attached(skeleton, each.foot, each.leg)) skeleton = std::move(*moved);
//
// Clips need no change. Their keys of such a node stay local to its old parent (Node::keys), and sample()
// converts them: at any time every node is where it was before, to rounding. The exception is a leg scaled
// unevenly, other than along the foot's own axes, which would shear the foot: it keeps its position but not
// its axes, and is_same_place() detects that. key_of() converts back.
#pragma once

#include <vector>

#include "tendril/humanoid/bone_map.hpp"

namespace tendril::humanoid {

struct LooseFoot {
    Bone bone = Bone::LeftFoot;
    std::size_t foot = 0;  ///< node with the name of this side's foot, not below the leg
    std::size_t leg = 0;   ///< node of the lower leg
    bool fits = false;     ///< the foot's rest position is a plausible end of the lower leg
};

/// At most one per side, if the map has its lower leg and no named foot is below it. A foot fits if it is
/// where the last node below the lower leg is; without such a node, if it continues the leg at a usual
/// length.
std::vector<LooseFoot> loose_feet(const Skeleton& skeleton, const BoneMap& map);

/// The skeleton with the node moved below `to`; it stays where it is, at rest and in clips. Refuses a node
/// that is above `to`, was moved already or would be sheared there.
Expected<Skeleton> attached(const Skeleton& skeleton, std::size_t node, std::size_t to);
/// The skeleton as it was before attached().
Skeleton detached(const Skeleton& skeleton);

/// True if two placements are the same, to 1e-6 of the distance from the origin, and to 1e-3 in their axes.
bool is_same_place(const Placement& a, const Placement& b) noexcept;

}  // namespace tendril::humanoid
