// A symmetric positive definite system of 3 x 3 blocks over any graph of particles, factorized as L D L^T.
// Not installed.
//
// Particles are eliminated in the order of fewest neighbours (A. George, J. Liu, "The Evolution of the
// Minimum Degree Ordering Algorithm", 1989): those between the ties of a rope first, each with two
// neighbours, so that what ropes cost grows with their segments, and only the few tied particles fill in.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "rope/chain_system.hpp"

namespace tendril::rope::detail {

/// The order, and where each block is. Depends on the graph alone.
struct Elimination {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;

    Elimination() = default;
    /// Of nodes numbered from 0. Edges may repeat.
    Elimination(std::uint32_t nodes, std::span<const Edge> edges);
    /// The block between two nodes that an edge joins, given by their places in the order.
    std::uint32_t block(std::uint32_t a, std::uint32_t b) const noexcept;

    std::vector<std::uint32_t> place;  ///< of each node, in the order
    std::vector<std::uint32_t> first;  ///< of each place: its first block; one more at the end
    std::vector<std::uint32_t> row;    ///< of each block: the later of its two places; ascending in a column
    std::vector<std::uint32_t> fill;   ///< of each pair of blocks of a column: the block that it changes
};

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
    void subtract(const Symmetric3& s) noexcept {
        m[0] -= s.xx, m[1] -= s.xy, m[2] -= s.xz, m[3] -= s.xy, m[4] -= s.yy, m[5] -= s.yz;
        m[6] -= s.xz, m[7] -= s.yz, m[8] -= s.zz;
    }
};

/// Its numbers. Blocks and places are those of the elimination.
struct EliminationSystem {
    std::vector<Symmetric3> diagonal;
    std::vector<Matrix3> blocks;  ///< the part of the row `row` in the column of the place
    std::vector<dvec3> x;         ///< the right side, then the solution

    void resize(const Elimination& order);
    void clear();
    /// Overwrites everything.
    void solve(const Elimination& order) noexcept;
};

}  // namespace tendril::rope::detail
