// FABRIK's two passes on a tree: forward reaching from the effectors, backward reaching from the root.
#include <cmath>

#include "ik/math.hpp"
#include "ik/tree/workspace.hpp"

namespace tendril::ik::detail {

void forward_reaching(TreeScratch& scratch) noexcept {
    for (std::size_t k = 1; k < scratch.used; ++k) {
        const Node& node = scratch.nodes[k];
        scratch.proposed[k] = times(node.goal, node.own_weight);
    }
    // Always from the last node to the first, so that the rounding of a mean does not depend on the
    // effectors' order.
    for (std::size_t k = scratch.used; k-- > 1;) {
        const Node& node = scratch.nodes[k];
        if (node.parent == 0) continue;
        const glm::vec3 proposal = at_length(scratch.proposed[k], scratch.at[node.parent], node.length);
        scratch.proposed[node.parent] = moved(scratch.proposed[node.parent], proposal, node.centroid_weight);
    }
}

void backward_reaching(TreeScratch& scratch) noexcept {
    scratch.next[0] = scratch.at[0];
    for (std::size_t k = 1; k < scratch.used; ++k) {
        const Node& node = scratch.nodes[k];
        scratch.next[k] = at_length(scratch.next[node.parent], scratch.proposed[k], node.length);
    }
}

Fit fit(const TreeScratch& scratch, std::span<const glm::vec3> places) noexcept {
    Fit result;
    double worst = 0.0;
    for (std::size_t i = 0; i < scratch.goal_count; ++i) {
        const std::size_t k = scratch.goals[i];
        const Node& node = scratch.nodes[k];
        const glm::dvec3 way = between(places[k], node.goal);
        const double squared = dot(way, way);
        result.cost += node.weight * squared;
        if (squared > worst) worst = squared;
    }
    result.worst = std::sqrt(worst);
    return result;
}

}  // namespace tendril::ik::detail
