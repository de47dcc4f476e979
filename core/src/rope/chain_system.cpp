#include "rope/chain_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tendril::rope::detail {
namespace {

constexpr double contact_compliance = 1e-8;  ///< for contacts with links, relative to the inverse mass
constexpr double max_stiffness = 1e9;        ///< relative to the mass
constexpr double max_multiplier = 1e9;       ///< relative to mass and rest
constexpr double min_freedom = 0.05;

/// Terms that eliminated nodes pass on to the next node.
struct Sweep {
    Symmetric3 matrix;
    dvec3 right{0.0};
    double stiffness = 0.0;
};
/// Terms for the next node but one, if the chain resists bending.
struct Beyond {
    Matrix3 across;  ///< the matrix block from the next node to the one after
    Symmetric3 matrix;
    dvec3 right{0.0};
};

/// a b
Matrix3 product(const Symmetric3& a, const Matrix3& b) noexcept {
    Matrix3 c;
    for (int i = 0; i < 3; ++i) {
        const dvec3 column = a * dvec3(b.m[i], b.m[3 + i], b.m[6 + i]);
        c.m[i] = column.x, c.m[3 + i] = column.y, c.m[6 + i] = column.z;
    }
    return c;
}

Matrix3 transposed(const Matrix3& a) noexcept {
    return {{a.m[0], a.m[3], a.m[6], a.m[1], a.m[4], a.m[7], a.m[2], a.m[5], a.m[8]}};
}

/// Removes a node's freedom to move along the normals of its planes. Skips a plane nearly parallel to an
/// earlier one, as it would fling the node far sideways.
void constrain(ChainNode& node, const NodeContact& contact) noexcept {
    const Symmetric3 free = node.mobility;
    for (int p = 0; p < contact.planes; ++p) {
        const dvec3& normal = contact.normal[p];
        const dvec3 moved = node.mobility * normal;
        const double freedom = dot(moved, normal);
        if (!(freedom > 1e-14 / node.mass)) continue;
        if (p > 0 && freedom < min_freedom * dot(free * normal, normal)) continue;
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
    if (contact != nullptr) constrain(node, *contact);
}

/// Eliminates a solved node and the bond that leads from it in the direction `along`.
inline Sweep eliminate(const ChainNode& node, ChainBond& bond, const dvec3& along, double weights) noexcept {
    const double s = bond.stiffness;
    const dvec3 moved = node.mobility * along;
    const double pivot = dot(along, moved) + bond.compliance / bond.stiffness_ratio;
    bond.row.inverse = weights > 0.0 ? 1.0 / pivot : 0.0;  // nothing to solve between two pinned nodes
    bond.row.next = along - s * moved;
    bond.row.right = bond.error / bond.stiffness_ratio - dot(along, node.offset);
    Sweep next;
    const double square = -s * s;
    const Symmetric3& m = node.mobility;
    next.matrix = {square * m.xx, square * m.xy, square * m.xz, square * m.yy, square * m.yz, square * m.zz};
    next.right = s * node.offset;
    next.stiffness = s;
    return next;
}

/// The same if bending couples the node to the next one, and by `to_second` to the one after. `beyond` brings
/// the terms of earlier nodes for the next node, and returns those for the one after.
Sweep eliminate(const ChainNode& node, ChainBond& bond, ChainBend& bend, double to_second, const dvec3& along,
                double weights, Beyond& beyond) noexcept {
    Sweep next = eliminate(node, bond, along, weights);
    const dvec3 moved = node.mobility * along;
    const Matrix3& to = bend.across;
    bond.row.next = along + to.transposed_by(moved);
    bond.row.second = to_second * moved;
    const Matrix3 by = product(node.mobility, to);
    next.matrix = beyond.matrix;
    const auto column = [](const Matrix3& a, int i) { return dvec3(a.m[i], a.m[3 + i], a.m[6 + i]); };
    next.matrix.xx -= dot(column(to, 0), column(by, 0)), next.matrix.xy -= dot(column(to, 0), column(by, 1));
    next.matrix.xz -= dot(column(to, 0), column(by, 2)), next.matrix.yy -= dot(column(to, 1), column(by, 1));
    next.matrix.yz -= dot(column(to, 1), column(by, 2)), next.matrix.zz -= dot(column(to, 2), column(by, 2));
    next.right = beyond.right - to.transposed_by(node.offset);
    const double square = -to_second * to_second;
    const Symmetric3& m = node.mobility;
    beyond.matrix = {square * m.xx, square * m.xy, square * m.xz,
                     square * m.yy, square * m.yz, square * m.zz};
    beyond.right = -to_second * node.offset;
    beyond.across = transposed(by);
    for (double& each : beyond.across.m) each *= -to_second;
    return next;
}

/// Eliminates a multiplier.
template <bool bent>
void couple(const MultiplierRow& row, Sweep& next, Beyond& beyond) noexcept {
    next.matrix.add(row.inverse, row.next, row.next);
    next.right -= (row.right * row.inverse) * row.next;
    if constexpr (bent) {
        beyond.matrix.add(row.inverse, row.second, row.second);
        beyond.across.add(row.inverse, row.next, row.second);
        beyond.right -= (row.right * row.inverse) * row.second;
    }
}

/// Subtracts a part of the row of a multiplier that is already eliminated.
void subtract(double part, const MultiplierRow& by, MultiplierRow& row) noexcept {
    row.next -= part * by.next;
    row.second -= part * by.second;
    row.right -= part * by.right;
}

/// Makes the row of a contact of the link behind `node`, which is `there` of the link away from it.
/// `across`: the matrix to the next node; null: only the link's stiffness leads there.
void add_contact(const ChainNode& node, const ChainBond& bond, const dvec3& along, double weights,
                 double there, const Matrix3* across, double to_second, const BondContact* last,
                 BondContact& contact) noexcept {
    contact.push = (there - 1.0) * contact.normal;
    const dvec3 moved = node.mobility * contact.push;
    MultiplierRow& row = contact.row;
    row.next =
        there * contact.normal + (across == nullptr ? -bond.stiffness * moved : across->transposed_by(moved));
    row.second = to_second * moved;
    row.right = contact.gap - dot(contact.push, node.offset);
    const double own = dot(contact.push, moved) + contact_compliance * weights;
    const double shared = dot(along, moved);
    double pivot = own - bond.row.inverse * shared * shared;
    contact.of_bond = bond.row.inverse * shared;
    subtract(contact.of_bond, bond.row, row);
    contact.of_last = 0.0;
    if (last != nullptr) {
        const double both = dot(last->push, moved) - last->of_bond * shared;
        contact.of_last = last->row.inverse * both;
        pivot -= contact.of_last * both;
        subtract(contact.of_last, last->row, row);
    }
    row.inverse = pivot > 1e-14 * own ? 1.0 / pivot : 0.0;
}

}  // namespace

void ChainSystem::evaluate(double extra_stiffness) noexcept {
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
            if (!bends.empty() && dot(bends[k].direction, bond.along) > 0.0) bond.stiffness *= tension_ahead;
            const double mass = std::max(node.mass, nodes[k + 1].mass);  // an end has half of it
            bond.stiffness = std::min(bond.stiffness + extra_stiffness * mass, max_stiffness * mass);
            bond.stiffness_ratio = std::max(1.0 - bond.compliance * bond.stiffness, 1e-9);
            pull = bond.multiplier * bond.along;
            if (!bends.empty() && dot(bends[k].direction, bond.along) > 0.0)
                pull = bond.multiplier *
                       (tension_ahead * bond.along + (1.0 - tension_ahead) * bends[k].direction);
            for (const BondContact& contact : contacts_of(bond)) {
                pull += (contact.multiplier * (1.0 - contact.at)) * contact.normal;
                push_next += contact.multiplier * contact.normal;
            }
        }
        node.force = node.mass * (node.base - node.x) + pull - pull_before;
        if (node.push >= 0) {
            const NodePush& push = pushes[static_cast<std::size_t>(node.push)];
            node.force += push.force + push.stiffness * (push.at - node.x);
        }
        // Tension pulls the next node back, but the contact's share pushes it.
        pull_before = pull - push_next;
    }
    for (std::size_t k = 1; k + 1 < bends.size(); ++k) {
        const ChainBend& bend = bends[k];
        const dvec3 moment =
            (bend_ahead * bend.stiffness) * bend.curvature(nodes[k - 1].x, nodes[k].x, nodes[k + 1].x) +
            bend.earlier;
        nodes[k - 1].force -= bend.before * moment;
        nodes[k].force += (bend.before + bend.after) * moment;
        nodes[k + 1].force -= bend.after * moment;
    }
}

double ChainSystem::max_error() const noexcept {
    double worst = 0.0;
    for (const ChainBond& bond : bonds)
        worst = std::max(worst, std::abs(bond.error) / std::max(bond.rest, 1e-9));
    return worst;
}

void ChainSystem::step() noexcept {
    bends.empty() ? solve<false>() : solve<true>();
}

template <bool bent>
void ChainSystem::solve() noexcept {
    const auto weight = [](const ChainNode& node) { return node.pinned ? 0.0 : 1.0 / node.mass; };
    const std::size_t last = nodes.size() - 1, middle = nodes.size() / 2;
    Beyond left_beyond, right_beyond;
    /// Eliminates node `k` towards node `next`.
    const auto pass = [&](const Sweep& before, Beyond& beyond, std::size_t k, std::size_t next) {
        const bool forward = next > k;
        ChainNode& node = nodes[k];
        ChainBond& bond = bonds[forward ? k : next];
        ChainBend* const bend = bent ? &bends[k] : nullptr;
        double stiffness = before.stiffness + bond.stiffness, to_second = 0.0;
        if constexpr (bent) {
            stiffness += bend->own;
            // The right side has eliminated the nodes beyond the middle.
            to_second = forward ? (next < middle ? bend->to_second : 0.0) : bends[k - 2].to_second;
            bend->across = beyond.across;
            const double to_next = bends[forward ? k : next].to_next - bond.stiffness;
            for (int i = 0; i < 9; i += 4) bend->across.m[i] += to_next;
        }
        solve_node(node, before, stiffness, contacts, pushes);
        const dvec3 along = forward ? bond.along : -bond.along;
        const double weights = weight(node) + weight(nodes[next]);
        Sweep after;
        if constexpr (bent)
            after = eliminate(node, bond, *bend, to_second, along, weights, beyond);
        else
            after = eliminate(node, bond, along, weights);
        couple<bent>(bond.row, after, beyond);
        const BondContact* last_contact = nullptr;
        for (BondContact& contact : contacts_of(bond)) {
            if (!contact.active) continue;
            const double there = forward ? contact.at : 1.0 - contact.at;
            add_contact(node, bond, along, weights, there, bent ? &bend->across : nullptr, to_second,
                        last_contact, contact);
            couple<bent>(contact.row, after, beyond);
            last_contact = &contact;
        }
        return after;
    };
    Sweep left, right;
    // Interleaved: neither side waits for the other.
    for (std::size_t k = 0; k < middle; ++k) {
        if (last - k > middle) right = pass(right, right_beyond, last - k, last - k - 1);
        if (bent && k + 1 == middle) {  // the right side has reached the middle: add its terms
            left.matrix.add(right_beyond.matrix);
            left.right += right_beyond.right;
            const Matrix3 across = transposed(right_beyond.across);
            for (int i = 0; i < 9; ++i) left_beyond.across.m[i] += across.m[i];
        }
        left = pass(left, left_beyond, k, k + 1);
    }
    ChainNode& node = nodes[middle];
    Sweep both = left;
    both.matrix.add(right.matrix);
    both.right += right.right;
    const double own = bent ? bends[middle].own : 0.0;
    solve_node(node, both, left.stiffness + right.stiffness + own, contacts, pushes);
    node.x += node.offset;
    /// The move of node `k`, from the moves of the next node and the next but one.
    const auto substitute = [&](const dvec3& next_by, const dvec3& second_by, std::size_t k,
                                std::size_t next) {
        const bool forward = next > k;
        ChainNode& here = nodes[k];
        ChainBond& bond = bonds[forward ? k : next];
        const dvec3 along = forward ? bond.along : -bond.along;
        dvec3 push;
        if constexpr (bent) {
            const double to_second = forward ? bends[k].to_second : bends[k - 2].to_second;
            push = -(bends[k].across * next_by) - to_second * second_by;
        } else {
            push = bond.stiffness * next_by;
        }
        const auto value = [&](const MultiplierRow& row) {
            double sum = dot(row.next, next_by) + row.right;
            if constexpr (bent) sum += dot(row.second, second_by);
            return sum * row.inverse;
        };
        double change = value(bond.row), of_last = 0.0;
        const std::span<BondContact> touching = contacts_of(bond);
        for (std::size_t c = touching.size(); c-- > 0;) {
            BondContact& contact = touching[c];
            if (!contact.active) continue;
            const double part = value(contact.row) - of_last;
            of_last = contact.of_last * part;
            change -= contact.of_bond * part;
            contact.multiplier -= part;
            push += part * contact.push;
        }
        const dvec3 by = here.offset + here.mobility * (change * along + push);
        // The stiffness acted along the link too; that part is tension.
        const double limit = max_multiplier * bond.rest * here.mass;
        bond.multiplier =
            std::clamp(bond.multiplier + change + bond.stiffness * dot(along, next_by - by), -limit, limit);
        here.x += by;
        return by;
    };
    dvec3 left_by = node.offset, right_by = node.offset, left_next(0.0), right_next(0.0);
    for (std::size_t k = middle; k-- > 0;) {
        const dvec3 by = substitute(left_by, left_next, k, k + 1);
        left_next = std::exchange(left_by, by);
        if (k + 1 == middle) right_next = by;
        const std::size_t mirrored = 2 * middle - k;
        if (mirrored > last) continue;
        const dvec3 mirrored_by = substitute(right_by, right_next, mirrored, mirrored - 1);
        right_next = std::exchange(right_by, mirrored_by);
    }
}

}  // namespace tendril::rope::detail
