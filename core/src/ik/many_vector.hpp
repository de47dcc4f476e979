// What solve_many does with vector registers, compiled once for each vector unit. Not installed.
#pragma once

#include <cstddef>
#include <string_view>

#include "ik/many_block.hpp"

namespace tendril::ik::detail {

struct PullOrder {
    int iterations;      ///< at most so many now
    int max_iterations;  ///< and so many in all, counted in Row::Iterations
    bool every;          ///< whether chains go on that have arrived
};

/// Both work on the first `lanes` lanes and what is left of the last register beyond them, and return how
/// many chains are active then.
struct VectorUnit {
    /// Reads joints, lengths and targets; lays what is loose to its lengths and what is out of reach
    /// straight; writes Row::Start, and all from Row::Residual on: Active is 1 where Plain and not there yet.
    std::size_t (*look)(const Block& block, std::size_t lanes, bool every);
    /// Pulls the active lanes; those that have arrived, stalled or used up their iterations become
    /// inactive.
    std::size_t (*pull)(const Block& block, std::size_t lanes, const PullOrder& order);
};

/// Null for a name that is not among vector_units().
const VectorUnit* vector_unit_named(std::string_view name) noexcept;

}  // namespace tendril::ik::detail
