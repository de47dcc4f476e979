// What Rig::make compiles from a definition, once. Not installed.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rig/resolve.hpp"
#include "tendril/rig/rig.hpp"

namespace tendril::rig::detail {

/// One element visited by a for-each.
struct Visit {
    std::uint32_t element = 0;
    std::uint32_t index = 0, count = 0;  ///< its position below its root
};

/// The compiled data of one unit, including those in bodies.
struct UnitPlan {
    std::vector<Visit> visits;            ///< for-each only: in order
    std::vector<std::uint32_t> bones;     ///< chain solvers only: the elements from root to tip
    std::optional<std::size_t> for_each;  ///< units in a body only: the for-each around them
    std::vector<Output> outputs;
};

/// How many rigs share a plan. Not std::shared_ptr: with sanitizers that check its virtual functions it needs
/// RTTI, which the library lacks.
struct Owners {
    mutable std::atomic<std::uint32_t> count{1};
    Owners() = default;
    Owners(Owners&&) noexcept {}
};

struct Plan {
    Owners owners;
    Definition definition;  ///< with names resolved
    Names elements, curves, units_by_name;
    std::vector<std::int64_t> parents;  ///< per element: the index of its parent, or -1
    std::vector<ElementId> ids;
    std::vector<std::string> unit_names;
    std::vector<UnitPlan> units;  ///< one per name
    State initial;
    std::uint64_t work = 0;  ///< of one solve, see Rig::work
};

}  // namespace tendril::rig::detail
