// The damped Gauss-Newton step on a tree.
//
// Finds the moves d of all nodes that minimise
//     sum over effectors of weight * |place + d - goal|^2  +  damping * sum over all of |d|^2
// such that no bone changes its length to first order: along . (d - d of the parent) = 0, with `along` the
// bone's direction. The contribution of a whole branch to that sum depends on the parent's move only through
// s = along . (d of the parent), and is a parabola in it: stiffness/2 * s^2 - wish * s. So one pass from the
// leaves inward collects the parabolas, and one from the root outward computes the moves.

#include "ik/tree/workspace.hpp"

namespace tendril::ik::detail {
namespace {

/// The bone's direction; along X if the bone is too short to have one.
glm::dvec3 unit_or_x(const glm::dvec3& bone) noexcept {
    return direction_of(bone, 1e-30).value_or(glm::dvec3(1.0, 0.0, 0.0));
}

/// Adds the branch's parabola to its parent.
void add_branch(Response& parent, const Response& branch) noexcept {
    add_square(parent.branches, branch.along, branch.stiffness);
    parent.force = plus(parent.force, times(branch.along, branch.pull));
}

void collect(TreeScratch& scratch, std::span<const glm::vec3> from, double damping) noexcept {
    for (std::size_t k = 0; k < scratch.used; ++k) {
        scratch.responses[k].branches = {};
        scratch.responses[k].force = glm::dvec3(0.0);
    }
    for (std::size_t k = scratch.used; k-- > 1;) {
        const Node& node = scratch.nodes[k];
        Response& r = scratch.responses[k];
        if (node.weight > 0.0) r.force = plus(r.force, times(between(from[k], node.goal), node.weight));
        r.along = unit_or_x(between(from[node.parent], from[k]));
        const Factors3 factors(r.branches, node.weight + damping);
        r.free = factors.solve(r.force);
        r.per_tension = factors.solve(r.along);
        r.stiffness = 1.0 / dot(r.along, r.per_tension);
        r.pull = dot(r.along, r.free) * r.stiffness;
        add_branch(scratch.responses[node.parent], r);
    }
}

}  // namespace

void newton_step(TreeScratch& scratch, std::span<const glm::vec3> from, double damping) noexcept {
    collect(scratch, from, damping);
    scratch.trial[0] = from[0];
    scratch.responses[0].free = glm::dvec3(0.0);
    for (std::size_t k = 1; k < scratch.used; ++k) {
        const Node& node = scratch.nodes[k];
        Response& r = scratch.responses[k];
        // From here on `free` is the move itself.
        const double tension = r.stiffness * dot(r.along, scratch.responses[node.parent].free) - r.pull;
        r.free = plus(r.free, times(r.per_tension, tension));
        // In double: with little damping a move may be very large.
        const glm::vec3& parent = scratch.trial[node.parent];
        const glm::dvec3 way = plus(between(parent, from[k]), r.free);
        scratch.trial[k] = moved(parent, unit_or_x(way), static_cast<double>(node.length));
    }
}

}  // namespace tendril::ik::detail
