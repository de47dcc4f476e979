// The elements that a for-each goes through, and what each of its rounds knows of where it is.
#pragma once

#include <cstddef>
#include <vector>

#include "tendril/rig/hierarchy.hpp"

namespace tendril::rig {

struct CollectOptions {
    bool include_parent = true;  ///< the root itself, first
    bool recursive = true;       ///< everything below it; otherwise its children only
    bool operator==(const CollectOptions&) const = default;
};

/// Appends what is below `root`, depth first, children in the order in which they were added. Refused where
/// there is no such element. O(what is appended); allocates only where `elements` has to grow. For several
/// roots call it once each: index, count and ratio begin anew with each root.
Result collect_children(const Hierarchy& hierarchy, ElementId root, const CollectOptions& options,
                        std::vector<ElementId>& elements);

/// Where in the list a round is, from 0 to 1: index / (count - 1), 0 where there is only one.
double loop_ratio(std::size_t index, std::size_t count) noexcept;

}  // namespace tendril::rig
