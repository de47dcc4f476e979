// The elements that a for-each visits, and the position of each visit.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/rig/hierarchy.hpp"

namespace tendril::rig {

struct CollectOptions {
    bool include_parent = true;  ///< the root itself, first
    bool recursive = true;       ///< everything below it; otherwise its children only
    bool operator==(const CollectOptions&) const = default;
};

/// Appends the elements below `root`, depth first, children in the order in which they were added. Refuses a
/// handle without an element. O(elements appended); allocates only if `elements` has to grow. For several
/// roots call it once for each: index, count and ratio start anew with each root.
Result collect_children(const Hierarchy& hierarchy, ElementId root, const CollectOptions& options,
                        std::vector<ElementId>& elements);

/// Position in the list from 0 to 1: index / (count - 1); 0 if there is only one element.
double loop_ratio(std::size_t index, std::size_t count) noexcept;

}  // namespace tendril::rig

template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::CollectOptions>() noexcept;
