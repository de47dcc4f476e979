// What Rig::make works out of a definition, once. Not installed.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rig/resolve.hpp"
#include "tendril/rig/rig.hpp"

namespace tendril::rig::detail {

/// An element that a for-each comes to.
struct Visit {
    std::uint32_t element = 0;
    std::uint32_t index = 0, count = 0;  ///< its place below its root
};

/// Of one unit, or one in a body.
struct UnitPlan {
    std::vector<Visit> visits;            ///< of a for-each, in order
    std::vector<std::uint32_t> bones;     ///< of a unit that solves a chain: its elements from root to tip
    std::optional<std::size_t> for_each;  ///< of a unit in a body: the one around it
    std::vector<Output> outputs;
};

/// How many rigs share a plan: std::shared_ptr would need RTTI where sanitizers look at its virtual
/// functions, and the library has none.
struct Owners {
    mutable std::atomic<std::uint32_t> count{1};
    Owners() = default;
    Owners(Owners&&) noexcept {}
};

struct Plan {
    Owners owners;
    Definition definition;  ///< with its names resolved
    Names elements, curves, units_by_name;
    std::vector<std::int64_t> parents;  ///< of each element, by index; -1 for none
    std::vector<ElementId> ids;
    std::vector<std::string> unit_names;
    std::vector<UnitPlan> units;  ///< one a name
    State initial;
    std::uint64_t work = 0;  ///< of a solve, see Rig::work
};

}  // namespace tendril::rig::detail
