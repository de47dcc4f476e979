// The damped Gauss-Newton step on a tree.
//
// Wanted are moves d of all places that make
//     sum over effectors of weight * |place + d - goal|^2  +  damping * sum over all of |d|^2
// least, where no bone changes its length to first order: along . (d - d of the parent) = 0, with `along` the
// bone's direction. What a whole branch adds to that sum depends on the parent's move only through
// s = along . (d of the parent), and is a parabola in it: stiffness/2 * s^2 - wish * s. So one pass from the
// leaves in collects the parabolas, and one from the root out reads off the moves.
#include <cmath>

#include "ik/tree/workspace.hpp"

namespace tendril::ik::detail {
namespace {

/// The bone's direction; along X where the bone is too short to show one.
glm::dvec3 direction_of(const glm::vec3& parent, const glm::vec3& place) noexcept {
    const glm::dvec3 bone = between(parent, place);
    const double squared = inner(bone, bone);
    if (squared < 1e-60) return {1.0, 0.0, 0.0};
    const double scale = 1.0 / std::sqrt(squared);
    return {bone.x * scale, bone.y * scale, bone.z * scale};
}

/// L D L' of a symmetric positive definite matrix; stable without pivoting, which the inverse by cofactors is
/// not: along a straight branch the stiffness across the bones is a millionth of that along them.
struct Factors {
    double l10, l20, l21, i0, i1, i2;

    Factors(const Response& m, double diagonal) noexcept {
        i0 = 1.0 / (m.xx + diagonal);
        l10 = m.xy * i0;
        l20 = m.xz * i0;
        i1 = 1.0 / (m.yy + diagonal - l10 * m.xy);
        const double e = m.yz - l20 * m.xy;
        l21 = e * i1;
        i2 = 1.0 / (m.zz + diagonal - l20 * m.xz - l21 * e);
    }
    glm::dvec3 solve(const glm::dvec3& v) const noexcept {
        const double y1 = v.y - l10 * v.x;
        const double y2 = v.z - l20 * v.x - l21 * y1;
        const double z = y2 * i2;
        const double y = y1 * i1 - l21 * z;
        return {v.x * i0 - l10 * y - l20 * z, y, z};
    }
};

/// Adds the branch's parabola to what the parent feels.
void add_branch(Response& parent, const Response& branch) noexcept {
    const glm::dvec3& u = branch.along;
    const double x = branch.stiffness * u.x, y = branch.stiffness * u.y, z = branch.stiffness * u.z;
    parent.xx += x * u.x;
    parent.yy += y * u.y;
    parent.zz += z * u.z;
    parent.xy += x * u.y;
    parent.xz += x * u.z;
    parent.yz += y * u.z;
    parent.force.x += branch.wish * u.x;
    parent.force.y += branch.wish * u.y;
    parent.force.z += branch.wish * u.z;
}

void collect(TreeScratch& scratch, std::span<const glm::vec3> from, double damping) noexcept {
    for (std::size_t k = 0; k < scratch.used; ++k) {
        Response& r = scratch.responses[k];
        r.xx = r.yy = r.zz = r.xy = r.xz = r.yz = 0.0;
        r.force = glm::dvec3(0.0);
    }
    for (std::size_t k = scratch.used; k-- > 1;) {
        const Node& node = scratch.nodes[k];
        Response& r = scratch.responses[k];
        if (node.weight > 0.0) {
            const glm::dvec3 gap = between(from[k], node.goal);
            r.force.x += node.weight * gap.x;
            r.force.y += node.weight * gap.y;
            r.force.z += node.weight * gap.z;
        }
        r.along = direction_of(from[node.parent], from[k]);
        const Factors factors(r, node.weight + damping);
        r.free = factors.solve(r.force);
        r.per_tension = factors.solve(r.along);
        r.stiffness = 1.0 / inner(r.along, r.per_tension);
        r.wish = inner(r.along, r.free) * r.stiffness;
        add_branch(scratch.responses[node.parent], r);
    }
}

/// At `length` from the parent towards `from + move`. In double: with little damping a move may be vast.
glm::vec3 placed(const glm::vec3& parent, const glm::vec3& from, const glm::dvec3& move,
                 float bone) noexcept {
    glm::dvec3 way = between(parent, from);
    way = {way.x + move.x, way.y + move.y, way.z + move.z};
    const double squared = inner(way, way);
    if (squared < 1e-60) return {parent.x + bone, parent.y, parent.z};
    const double scale = static_cast<double>(bone) / std::sqrt(squared);
    return {static_cast<float>(static_cast<double>(parent.x) + way.x * scale),
            static_cast<float>(static_cast<double>(parent.y) + way.y * scale),
            static_cast<float>(static_cast<double>(parent.z) + way.z * scale)};
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
        const double tension = r.stiffness * inner(r.along, scratch.responses[node.parent].free) - r.wish;
        r.free.x += tension * r.per_tension.x;
        r.free.y += tension * r.per_tension.y;
        r.free.z += tension * r.per_tension.z;
        scratch.trial[k] = placed(scratch.trial[node.parent], from[k], r.free, node.length);
    }
}

}  // namespace tendril::ik::detail
