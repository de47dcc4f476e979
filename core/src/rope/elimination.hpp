// Symmetric positive definite systems, factorized as L D L^T: of 3 x 3 blocks over any graph of particles,
// and dense. Not installed.
//
// The particle with the fewest neighbours is always eliminated next (A. George, J. Liu, "The Evolution of the
// Minimum Degree Ordering Algorithm", 1989). Those between the ties of a rope have two and go first, so ropes
// cost O(segments), and only the few tied particles fill in.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "rope/chain_system.hpp"

namespace tendril::rope::detail {

/// The order of elimination, and the index of each block. Depends on the graph alone.
struct Elimination {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;

    Elimination() = default;
    /// Nodes are numbered from 0; edges may repeat. `late`: for each node, whether it is among the last.
    Elimination(std::span<const std::uint8_t> late, std::span<const Edge> edges);
    /// The block between two nodes that an edge joins, given by their places in the order.
    std::uint32_t block(std::uint32_t a, std::uint32_t b) const noexcept;

    std::vector<std::uint32_t> rank;   ///< place of each node in the order
    std::vector<std::uint32_t> first;  ///< first block of each place; one more at the end
    std::vector<std::uint32_t> row;    ///< later place of each block; ascending in a column
    std::vector<std::uint32_t> fill;   ///< block changed by each pair of blocks of a column
    std::uint32_t late = 0;            ///< the first place of the last nodes
};

/// The numbers of a system. Blocks and places as in its Elimination.
struct EliminationSystem {
    std::vector<Symmetric3> diagonal;
    std::vector<Matrix3> blocks;  ///< the part of the row `row` in the column of the place
    std::vector<dvec3> x;         ///< the right side, then the solution

    void resize(const Elimination& order);
    void clear();
    /// Replaces the blocks by their factors and eliminates in x; substitute() then gives the solution.
    void factorize(const Elimination& order) noexcept;
    /// For factors and any right side: eliminate() starts at place `from`, before which the right side is 0;
    /// substitute() computes the solution down to place `to`.
    void eliminate(const Elimination& order, std::vector<dvec3>& right, std::uint32_t from) const noexcept;
    void substitute(const Elimination& order, std::vector<dvec3>& right, std::uint32_t to) const noexcept;
};

/// A small dense system. Every loop runs along a row, over numbers that do not depend on each other.
struct DenseSystem {
    std::size_t size = 0;
    std::vector<double> matrix;  ///< by rows; the part above the diagonal is overwritten

    void resize(std::size_t numbers);
    /// Factorizes the first `n` rows. factorize_row() adds a row to that factor, up to its diagonal, and
    /// returns the pivot relative to the diagonal. A row with a small pivot can be dropped.
    void factorize(std::size_t n) noexcept;
    double factorize_row(std::size_t row) noexcept;
    void drop_row(std::size_t row) noexcept;
    /// Turns a right side of the first `n` numbers into the solution.
    void solve(double* x, std::size_t n) const noexcept;
};

}  // namespace tendril::rope::detail
