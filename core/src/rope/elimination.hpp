// Symmetric positive definite systems, factorized as L D L^T: of 3 x 3 blocks over any graph of particles,
// and dense. Not installed.
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
    /// Of nodes numbered from 0. Edges may repeat. `late`: of each node, whether it is among the last.
    Elimination(std::span<const std::uint8_t> late, std::span<const Edge> edges);
    /// The block between two nodes that an edge joins, given by their places in the order.
    std::uint32_t block(std::uint32_t a, std::uint32_t b) const noexcept;

    std::vector<std::uint32_t> place;  ///< of each node, in the order
    std::vector<std::uint32_t> first;  ///< of each place: its first block; one more at the end
    std::vector<std::uint32_t> row;    ///< of each block: the later of its two places; ascending in a column
    std::vector<std::uint32_t> fill;   ///< of each pair of blocks of a column: the block that it changes
    std::uint32_t late = 0;            ///< the first place of the last nodes
};

/// Its numbers. Blocks and places are those of the elimination.
struct EliminationSystem {
    std::vector<Symmetric3> diagonal;
    std::vector<Matrix3> blocks;  ///< the part of the row `row` in the column of the place
    std::vector<dvec3> x;         ///< the right side, then the solution

    void resize(const Elimination& order);
    void clear();
    /// Replaces the blocks by their factors and eliminates in x; substitute() then gives the solution.
    void factorize(const Elimination& order) noexcept;
    /// With factors and any right side: eliminates in it, where it is 0 before a place; then computes the
    /// solution, down to a place.
    void eliminate(const Elimination& order, std::vector<dvec3>& right, std::uint32_t from) const noexcept;
    void substitute(const Elimination& order, std::vector<dvec3>& right, std::uint32_t to) const noexcept;
};

/// A small dense system. Every loop runs along a row, over numbers that do not depend on each other.
struct DenseSystem {
    std::size_t size = 0;
    std::vector<double> matrix;  ///< by rows; what lies above the diagonal is overwritten

    void resize(std::size_t numbers);
    /// Of the first `n` numbers. A row can be added to their factor: it is then factorized, with what
    /// precedes its diagonal; returns the pivot over the diagonal. One with a small pivot can be dropped.
    void factorize(std::size_t n) noexcept;
    double factorize_row(std::size_t row) noexcept;
    void drop_row(std::size_t row) noexcept;
    /// Turns a right side of the first `n` numbers into the solution.
    void solve(double* x, std::size_t n) const noexcept;
};

}  // namespace tendril::rope::detail
