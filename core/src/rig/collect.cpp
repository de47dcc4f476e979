#include "tendril/rig/collect.hpp"

namespace tendril::rig {

Result collect_children(const Hierarchy& hierarchy, ElementId root, const CollectOptions& options,
                        std::vector<ElementId>& elements) {
    if (const Result bad = hierarchy.check(root, "collect_children", "root"); !bad) return bad;
    if (options.include_parent) elements.push_back(root);
    if (options.recursive) {
        for (ElementId at = hierarchy.next_depth_first(root, root); at;
             at = hierarchy.next_depth_first(at, root))
            elements.push_back(at);
    } else {
        for (ElementId at = hierarchy.first_child(root); at; at = hierarchy.next_sibling(at))
            elements.push_back(at);
    }
    return {};
}

double loop_ratio(std::size_t index, std::size_t count) noexcept {
    return count > 1 ? static_cast<double>(index) / static_cast<double>(count - 1) : 0.0;
}

}  // namespace tendril::rig

template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::CollectOptions>() noexcept {
    using rig::CollectOptions;
    static constexpr Field rows[] = {field<&CollectOptions::include_parent>("include_parent"),
                                     field<&CollectOptions::recursive>("recursive")};
    return rows;
}
