// A body found by its shape alone, for skeletons whose nodes have no names, or say nothing with them. Not
// installed.
#pragma once

#include <array>

#include "tendril/humanoid/bone_map.hpp"

namespace tendril::humanoid::detail {

/// -1 where nothing was found.
struct ShapeReading {
    std::array<std::int32_t, bone_count> nodes;
    bool knows_left;  ///< by the direction in which the feet point; otherwise the figure is taken to face +Z

    std::int32_t& operator[](Bone bone) noexcept { return nodes[static_cast<std::size_t>(bone)]; }
    std::int32_t operator[](Bone bone) const noexcept { return nodes[static_cast<std::size_t>(bone)]; }
};

/// The node from which two equal limbs go down and a column goes up; on that column the node from which two
/// equal limbs branch; above it the head. The two longest bones in a row are a limb's upper and lower one.
ShapeReading read_shape(const Skeleton& skeleton);

}  // namespace tendril::humanoid::detail
