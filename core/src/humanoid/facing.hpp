// Which way a character faces, and where its feet end. Not installed.
#pragma once

#include <optional>
#include <span>

#include "tendril/humanoid/t_pose.hpp"

namespace tendril::humanoid::detail {

/// As facing(); nothing where neither legs nor arms are side by side. `rest`: where the rest pose has the
/// nodes.
std::optional<Facing> find_facing(const Skeleton& skeleton, const BoneMap& map,
                                  std::span<const Placement> rest);

/// What hangs on a node farthest from it, seen from above: on a foot, the tip of the toes. The node itself
/// where nothing does.
std::size_t farthest_below(const Skeleton& skeleton, std::span<const Placement> rest, std::size_t node);

}  // namespace tendril::humanoid::detail
