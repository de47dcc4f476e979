// Finds a body by its shape alone, for skeletons without meaningful names. Not installed.
#pragma once

#include <array>

#include "tendril/humanoid/bone_map.hpp"

namespace tendril::humanoid::detail {

struct ShapeReading {
    std::array<std::int32_t, bone_count> nodes;  ///< -1: not found
    bool left_known;  ///< from the direction of the feet; if false, the figure is assumed to face +Z

    std::int32_t& operator[](Bone bone) noexcept { return nodes[static_cast<std::size_t>(bone)]; }
    std::int32_t operator[](Bone bone) const noexcept { return nodes[static_cast<std::size_t>(bone)]; }
};

/// The hips are the node from which two equal limbs go down and a column goes up. On the column, two equal
/// limbs branch off; the head is above them. The two longest consecutive bones are a limb's upper and lower
/// bones.
ShapeReading read_shape(const Skeleton& skeleton);

}  // namespace tendril::humanoid::detail
