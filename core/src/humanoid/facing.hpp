// The direction that a character faces, and the ends of its feet. Not installed.
#pragma once

#include <optional>
#include <span>

#include "tendril/humanoid/t_pose.hpp"

namespace tendril::humanoid::detail {

/// Like facing(), but nullopt if neither legs nor arms are side by side. `rest`: placements of the rest pose.
std::optional<Facing> find_facing(const Skeleton& skeleton, const BoneMap& map,
                                  std::span<const Placement> rest);

/// The node below `node` with the largest horizontal distance from it: for a foot, the tip of the toes.
/// Returns `node` if there is none.
std::size_t farthest_below(const Skeleton& skeleton, std::span<const Placement> rest, std::size_t node);

}  // namespace tendril::humanoid::detail
