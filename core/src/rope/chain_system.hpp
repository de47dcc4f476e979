// The linear system of one chain among colliders: its lengths and its contacts. Not installed.
//
// One step of Newton's method for a substep. Node j has mass m. Link k leads from node k to the next along
// the unit vector n, with the multiplier t (tension times h^2), which adds the sideways stiffness s = t /
// length. For displacements dx and changes dt:
//
//     (m + s_{j-1} + s_j) dx_j - s_{j-1} dx_{j-1} - s_j dx_{j+1} + n_{j-1} dt_{j-1} - n_j dt_j = force_j
//     n_k (dx_{k+1} - dx_k) - compliance dt_k = -(length - rest - compliance t_k)
//
// Where nodes resist bending, forces also lead to the next node but one, and the blocks are pentadiagonal.
//
// A node in contact moves by a given distance along the normal, and against friction tangentially; a link in
// contact does so at the points that touch. Nodes are eliminated from both ends towards the middle, each
// with the link behind it: 3 x 3 blocks, O(n). The matrix is symmetric and quasi-definite, so this is stable
// without pivoting (R. Vanderbei, "Symmetric quasidefinite matrices", 1995).
#pragma once

#include <cstdint>
#include <span>

#include "rope/geometry.hpp"

namespace tendril::rope::detail {

/// A symmetric 3 x 3 matrix.
struct Symmetric3 {
    double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;

    dvec3 operator*(const dvec3& v) const noexcept {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                xz * v.x + yz * v.y + zz * v.z};
    }
    /// Adds `by` times a b^T, which must be symmetric.
    void add(double by, const dvec3& a, const dvec3& b) noexcept {
        const dvec3 w = by * a;
        xx += w.x * b.x, xy += w.x * b.y, xz += w.x * b.z;
        yy += w.y * b.y, yz += w.y * b.z, zz += w.z * b.z;
    }
    void add(const Symmetric3& by) noexcept {
        xx += by.xx, xy += by.xy, xz += by.xz, yy += by.yy, yz += by.yz, zz += by.zz;
    }
};

inline Symmetric3 inverse_of(const Symmetric3& m) noexcept {
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

/// A general 3 x 3 matrix, by rows.
struct Matrix3 {
    double m[9] = {};

    dvec3 operator*(const dvec3& v) const noexcept {
        return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
                m[6] * v.x + m[7] * v.y + m[8] * v.z};
    }
    dvec3 transposed_by(const dvec3& v) const noexcept {
        return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
                m[2] * v.x + m[5] * v.y + m[8] * v.z};
    }
    void add(double by, const dvec3& a, const dvec3& b) noexcept {
        const dvec3 w = by * a;
        m[0] += w.x * b.x, m[1] += w.x * b.y, m[2] += w.x * b.z;
        m[3] += w.y * b.x, m[4] += w.y * b.y, m[5] += w.y * b.z;
        m[6] += w.z * b.x, m[7] += w.z * b.y, m[8] += w.z * b.z;
    }
    void subtract(const Symmetric3& s) noexcept {
        m[0] -= s.xx, m[1] -= s.xy, m[2] -= s.xz, m[3] -= s.xy, m[4] -= s.yy, m[5] -= s.yz;
        m[6] -= s.xz, m[7] -= s.yz, m[8] -= s.zz;
    }
};

struct ChainNode {
    dvec3 x{0.0};               ///< current position
    dvec3 base{0.0};            ///< position without links and contacts
    double mass = 1.0;          ///< kg, over 0
    std::int32_t contact = -1;  ///< index of its NodeContact; negative: none
    std::int32_t push = -1;     ///< index of its NodePush; negative: none
    bool pinned = false;
    dvec3 force{0.0};  ///< residual force, times h^2; without contact
    // Within a step: moves by `offset`, plus `mobility` times any further force.
    dvec3 offset{0.0};
    Symmetric3 mobility;
};

/// The force of other segments on a node.
struct NodePush {
    std::uint32_t node = 0;
    dvec3 at{0.0};         ///< where the node was expected
    dvec3 force{0.0};      ///< there, times h^2
    Symmetric3 stiffness;  ///< decrease of the force per move of the node, times h^2
};

/// Within a step: expresses a multiplier between two nodes by the displacement of the second in elimination
/// order and, if the chain bends, of the one after.
struct MultiplierRow {
    dvec3 next{0.0}, second{0.0};
    double right = 0.0, inverse = 0.0;
};

/// A link, from its node to the next.
struct ChainBond {
    static constexpr int max_contacts = 2;  ///< what keeps a stick from turning about one of them
    double rest = 0.0;                      ///< metres
    double compliance = 0.0;                ///< m/N, over h^2
    double multiplier = 0.0;                ///< tension times h^2
    std::int32_t contact = -1;              ///< index of its first BondContact; negative: none
    dvec3 along{0.0};                       ///< unit
    double error = 0.0;                     ///< metres too long
    double stiffness = 0.0;                 ///< sideways, times h^2
    double stiffness_ratio = 1.0;           ///< part of the stiffness along it left by compliance
    MultiplierRow row;
};

/// The effect of contacts on a node.
struct NodeContact {
    static constexpr int max_planes = 3;
    dvec3 normal[max_planes];  ///< planes that hold the node
    double gap[max_planes];    ///< metres above each
    int planes = 0;
    double drag = 0.0;  ///< friction, times h^2, over the slip distance
    dvec3 slip{0.0};    ///< metres
};

/// A contact of a link between its ends.
struct BondContact {
    bool active = false;
    dvec3 normal{0.0};
    double at = 0.5;          ///< where on the link, from 0 at its node to 1 at the next
    double gap = 0.0;         ///< metres
    double multiplier = 0.0;  ///< force times h^2
    // Within a step:
    MultiplierRow row;
    dvec3 push{0.0};                      ///< displacement of its node for its multiplier, without mobility
    double of_bond = 0.0, of_last = 0.0;  ///< parts of its row in the link's and in the contact's before it
};

/// Bending at a node: a moment of stiffness times the curvature before (x_{j-1} - x_j) + after (x_{j+1} -
/// x_j), linear in positions (M. Bergou et al., "A Quadratic Bending Model for Inextensible Surfaces", 2006).
struct ChainBend {
    double stiffness = 0.0;            ///< N m^2 over the mean length of its links, times h^2; 0 at the ends
    double before = 0.0, after = 0.0;  ///< over the length of each link, 1/m
    dvec3 earlier{0.0};                ///< known part of the moment
    dvec3 direction{0.0};              ///< link direction one substep before the last, unit; 0: unknown
    double own = 0.0;                  ///< added to the matrix of its node,
    double to_next = 0.0, to_second = 0.0;  ///< and to the matrices to the next node and next but one
    Matrix3 across;  ///< within a step: the matrix that leads to the next node in elimination order

    dvec3 curvature(const dvec3& previous, const dvec3& x, const dvec3& next) const noexcept {
        return before * (previous - x) + after * (next - x);
    }
};
/// Weight of the end of the substep in curvature and in the direction of tension; the remainder goes to one
/// substep before the last. At 0.5 no energy would be lost, and a stiff rope would ring for ever.
inline constexpr double bend_ahead = 0.6, tension_ahead = 0.51;

struct ChainSystem {
    std::span<ChainNode> nodes;
    std::span<ChainBond> bonds;  ///< one fewer than nodes
    std::span<const NodeContact> contacts;
    std::span<BondContact> bond_contacts;  ///< ChainBond::max_contacts for each link that has any
    std::span<const NodePush> pushes;
    std::span<ChainBend> bends;  ///< by node; empty: nothing resists bending

    /// Computes directions, errors and forces from the positions of nodes. `extra_stiffness`: sideways
    /// stiffness in addition to the tension's, relative to a node's mass, so that a step turns links less.
    void evaluate(double extra_stiffness) noexcept;
    /// Moves nodes and changes multipliers by one step, after evaluate().
    void step() noexcept;
    double max_error() const noexcept;  ///< length error of a link, relative to its rest length

  private:
    std::span<BondContact> contacts_of(const ChainBond& bond) const noexcept {
        if (bond.contact < 0) return {};
        return bond_contacts.subspan(static_cast<std::size_t>(bond.contact), ChainBond::max_contacts);
    }
    template <bool bent>
    void solve() noexcept;
};

}  // namespace tendril::rope::detail
