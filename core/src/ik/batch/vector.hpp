// What solve_many does with vector registers, compiled once for each vector unit. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ik/batch/block.hpp"

namespace tendril::ik::detail {

struct PullOrder {
    int iterations;      ///< at most so many now
    int max_iterations;  ///< and so many in all, counted in Row::Iterations
    bool every;          ///< whether chains go on that have arrived
};

// Both work on the first `lanes` lanes and what is left of the last register beyond them, where none may be
// active, and return how many chains are active then.

/// Reads joints, lengths and targets; lays what is loose to its lengths and what is out of reach straight;
/// writes Row::Start, and all from Row::Residual on: Active is 1 where Plain and not there yet.
using Look = std::size_t(const Block& block, std::size_t lanes, bool every);
/// Pulls the active lanes; those that have arrived, stalled or used up their iterations become inactive.
using Pull = std::size_t(const Block& block, std::size_t lanes, const PullOrder& order);

struct VectorUnit {
    Look* look = nullptr;
    Pull* pull = nullptr;
};

/// As compiled for one of Highway's targets.
Look* look_with(std::int64_t target) noexcept;
Pull* pull_with(std::int64_t target) noexcept;

/// Null for a name that is not among vector_units().
const VectorUnit* vector_unit_named(std::string_view name) noexcept;

}  // namespace tendril::ik::detail
