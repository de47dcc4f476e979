#include "rope/chain_system.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::rope::detail {
namespace {

constexpr double softness = 1e-8;       ///< of contacts with links, relative to the inverse mass
constexpr double max_stiffness = 1e9;   ///< relative to the mass
constexpr double max_multiplier = 1e9;  ///< relative to mass and rest
constexpr double enough_freedom = 0.05;

/// What eliminated nodes pass on to the next.
struct Sweep {
    Symmetric3 matrix;
    dvec3 right{0.0};
    double stiffness = 0.0;
};

Symmetric3 inverse_of(const Symmetric3& m) noexcept {
    const double xx = m.yy * m.zz - m.yz * m.yz, xy = m.xz * m.yz - m.xy * m.zz,
                 xz = m.xy * m.yz - m.xz * m.yy;
    const double by = 1.0 / (m.xx * xx + m.xy * xy + m.xz * xz);
    return {by * xx,
            by * xy,
            by * xz,
            by * (m.xx * m.zz - m.xz * m.xz),
            by * (m.xy * m.xz - m.xx * m.yz),
            by * (m.xx * m.yy - m.xy * m.xy)};
}

/// Removes a node's freedom to move along the normals of its planes. Of two nearly parallel planes the second
/// is skipped if the first left too little freedom: it would fling the node far sideways.
void hold(ChainNode& node, const NodeContact& contact) noexcept {
    const Symmetric3 free = node.mobility;
    for (int p = 0; p < contact.planes; ++p) {
        const dvec3& normal = contact.normal[p];
        const dvec3 moved = node.mobility * normal;
        const double freedom = dot(moved, normal);
        if (!(freedom > 1e-14 / node.mass)) continue;
        if (p > 0 && freedom < enough_freedom * dot(free * normal, normal)) continue;
        const double inverse = 1.0 / freedom;
        node.offset -= (inverse * (contact.gap[p] + dot(normal, node.offset))) * moved;
        node.mobility.add(-inverse, moved, moved);
    }
}

inline void solve_node(ChainNode& node, const Sweep& before, double stiffness,
                       std::span<const NodeContact> contacts, std::span<const NodePush> pushes) noexcept {
    if (node.pinned) {
        node.mobility = {};
        node.offset = dvec3(0.0);
        return;
    }
    const NodeContact* const contact =
        node.contact < 0 ? nullptr : &contacts[static_cast<std::size_t>(node.contact)];
    double diagonal = node.mass + stiffness;
    dvec3 right = before.right + node.force;
    if (contact != nullptr) diagonal += contact->drag, right -= contact->drag * contact->slip;
    Symmetric3 matrix = before.matrix;
    matrix.xx += diagonal, matrix.yy += diagonal, matrix.zz += diagonal;
    if (node.push >= 0) {
        const Symmetric3& more = pushes[static_cast<std::size_t>(node.push)].stiffness;
        matrix.xx += more.xx, matrix.xy += more.xy, matrix.xz += more.xz;
        matrix.yy += more.yy, matrix.yz += more.yz, matrix.zz += more.zz;
    }
    node.mobility = inverse_of(matrix);
    node.offset = node.mobility * right;
    if (contact != nullptr) hold(node, *contact);
}

/// Eliminates a solved node and the bond that leads from it in the direction `along`.
inline Sweep eliminate(const ChainNode& node, ChainBond& bond, const dvec3& along, double weights) noexcept {
    const double s = bond.stiffness;
    const dvec3 moved = node.mobility * along;
    const double pivot = dot(along, moved) + bond.compliance / bond.pliant;
    bond.inverse = weights > 0.0 ? 1.0 / pivot : 0.0;  // nothing to solve between two pinned nodes
    bond.row = along - s * moved;
    bond.right = bond.error / bond.pliant - dot(along, node.offset);
    Sweep next;
    const double square = -s * s;
    const Symmetric3& m = node.mobility;
    next.matrix = {square * m.xx, square * m.xy, square * m.xz, square * m.yy, square * m.yz, square * m.zz};
    next.right = s * node.offset;
    next.stiffness = s;
    return next;
}

/// Adds the bond's multiplier, the only unknown between the two nodes.
inline void couple(const ChainBond& bond, Sweep& next) noexcept {
    next.matrix.add(bond.inverse, bond.row, bond.row);
    next.right -= (bond.right * bond.inverse) * bond.row;
}

/// Adds the contact's multiplier too; `here` and `there` are its shares on the node and on the next.
void couple(const ChainNode& node, ChainBond& bond, const dvec3& along, double weights, BondContact& contact,
            double here, double there, Sweep& next) noexcept {
    const dvec3 push = here * contact.normal, moved = node.mobility * push;
    contact.row = there * contact.normal + bond.stiffness * moved;
    contact.right = contact.gap + dot(push, node.offset);
    contact.coupled = -dot(along, moved);
    const double own = dot(push, moved) + softness * weights;
    const double pivot = bond.inverse > 0.0 ? 1.0 / bond.inverse : 0.0;
    const double determinant = pivot * own - contact.coupled * contact.coupled;
    if (!(determinant > 1e-14 * pivot * own)) {
        contact.inverse = 0.0;
        couple(bond, next);
        return;
    }
    contact.inverse = 1.0 / determinant;
    const double a = own * contact.inverse, b = -contact.coupled * contact.inverse,
                 c = pivot * contact.inverse;
    const dvec3 first = a * bond.row + b * contact.row, second = b * bond.row + c * contact.row;
    next.matrix.add(1.0, first, bond.row);
    next.matrix.add(1.0, second, contact.row);
    next.right -= bond.right * first + contact.right * second;
    // Stores the inverse of the 2 x 2 matrix.
    bond.inverse = a, contact.coupled = b, contact.inverse = c;
}

}  // namespace

void ChainSystem::evaluate(double stiffer) noexcept {
    dvec3 pull_before(0.0);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        ChainNode& node = nodes[k];
        dvec3 pull(0.0), push_next(0.0);
        if (k < bonds.size()) {
            ChainBond& bond = bonds[k];
            const dvec3 by = nodes[k + 1].x - node.x;
            const double is = length(by);
            bond.along = is > 1e-30 ? (1.0 / is) * by : dvec3(1.0, 0.0, 0.0);
            const double tension = std::max(bond.multiplier, 0.0);
            bond.error = is - bond.rest - bond.compliance * bond.multiplier;
            bond.stiffness = tension / std::max(bond.rest + bond.compliance * tension, 1e-9);
            bond.stiffness = std::min(bond.stiffness + stiffer * node.mass, max_stiffness * node.mass);
            bond.pliant = std::max(1.0 - bond.compliance * bond.stiffness, 1e-9);
            pull = bond.multiplier * bond.along;
            if (bond.contact >= 0) {
                const BondContact& contact = bond_contacts[static_cast<std::size_t>(bond.contact)];
                pull += (contact.multiplier * (1.0 - contact.at)) * contact.normal;
                push_next = contact.multiplier * contact.normal;
            }
        }
        node.force = node.mass * (node.base - node.x) + pull - pull_before;
        if (node.push >= 0) {
            const NodePush& push = pushes[static_cast<std::size_t>(node.push)];
            node.force += push.force + push.stiffness * (push.at - node.x);
        }
        // On the next node tension pulls back, but the contact's share pushes.
        pull_before = pull - push_next;
    }
}

double ChainSystem::largest_error() const noexcept {
    double worst = 0.0;
    for (const ChainBond& bond : bonds)
        worst = std::max(worst, std::abs(bond.error) / std::max(bond.rest, 1e-9));
    return worst;
}

void ChainSystem::step() noexcept {
    const auto weight = [](const ChainNode& node) { return node.pinned ? 0.0 : 1.0 / node.mass; };
    /// Eliminates node `k` towards node `next`.
    const auto pass = [&](const Sweep& before, std::size_t k, std::size_t next) {
        const bool forward = next > k;
        ChainNode& node = nodes[k];
        ChainBond& bond = bonds[forward ? k : next];
        solve_node(node, before, before.stiffness + bond.stiffness, contacts, pushes);
        const dvec3 along = forward ? bond.along : -bond.along;
        const double weights = weight(node) + weight(nodes[next]);
        Sweep after = eliminate(node, bond, along, weights);
        BondContact* const contact =
            bond.contact < 0 ? nullptr : &bond_contacts[static_cast<std::size_t>(bond.contact)];
        if (contact == nullptr || !contact->active) {
            couple(bond, after);
        } else {
            const double t = forward ? contact->at : 1.0 - contact->at;
            couple(node, bond, along, weights, *contact, 1.0 - t, t, after);
        }
        return after;
    };
    const std::size_t last = nodes.size() - 1, middle = nodes.size() / 2;
    Sweep left, right;
    // Interleaved: neither side waits for the other.
    for (std::size_t k = 0; k < middle; ++k) {
        left = pass(left, k, k + 1);
        if (last - k > middle) right = pass(right, last - k, last - k - 1);
    }
    ChainNode& node = nodes[middle];
    Sweep both = left;
    both.matrix.xx += right.matrix.xx, both.matrix.xy += right.matrix.xy, both.matrix.xz += right.matrix.xz;
    both.matrix.yy += right.matrix.yy, both.matrix.yz += right.matrix.yz, both.matrix.zz += right.matrix.zz;
    both.right += right.right;
    solve_node(node, both, left.stiffness + right.stiffness, contacts, pushes);
    node.x += node.offset;
    const auto substitute = [&](const dvec3& next_by, std::size_t k, std::size_t next) {
        const bool forward = next > k;
        ChainNode& here = nodes[k];
        ChainBond& bond = bonds[forward ? k : next];
        const dvec3 along = forward ? bond.along : -bond.along;
        double right_here = dot(bond.row, next_by) + bond.right, change = right_here * bond.inverse;
        dvec3 push = bond.stiffness * next_by;
        BondContact* const contact =
            bond.contact < 0 ? nullptr : &bond_contacts[static_cast<std::size_t>(bond.contact)];
        if (contact != nullptr && contact->active && contact->inverse > 0.0) {
            const double other = dot(contact->row, next_by) + contact->right;
            change += other * contact->coupled;
            const double pressed = right_here * contact->coupled + other * contact->inverse;
            contact->multiplier -= pressed;
            push -= (pressed * (forward ? 1.0 - contact->at : contact->at)) * contact->normal;
        }
        const dvec3 by = here.offset + here.mobility * (change * along + push);
        // The stiffness acted along the link too; that part is tension.
        const double most = max_multiplier * bond.rest * here.mass;
        bond.multiplier =
            std::clamp(bond.multiplier + change + bond.stiffness * dot(along, next_by - by), -most, most);
        here.x += by;
        return by;
    };
    dvec3 left_by = node.offset, right_by = node.offset;
    for (std::size_t k = middle; k-- > 0;) {
        left_by = substitute(left_by, k, k + 1);
        const std::size_t mirrored = 2 * middle - k;
        if (mirrored <= last) right_by = substitute(right_by, mirrored, mirrored - 1);
    }
}

}  // namespace tendril::rope::detail
