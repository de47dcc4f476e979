// Why is this element here? What each unit did to its pose in a forward solve, in order.
#pragma once

#include <cstddef>
#include <vector>

#include "tendril/rig/workspace.hpp"

namespace tendril::rig {

/// From one global pose to the next: `after` is compose(before, change), to rounding.
struct Contribution {
    Transform before{}, after{}, change{};
    double metres = 0.0;   ///< how far it moved
    double radians = 0.0;  ///< and turned
};

struct Explanation {
    Transform input{};                  ///< where it was before the first unit
    std::vector<Contribution> units{};  ///< one a unit of Definition::units, in order
    Transform result{};                 ///< where it is
};

/// Solves a copy of the state without letting time pass. Cost: that of a solve and of one read a unit;
/// allocates. `element` is an index into Definition::elements.
Explanation explain(const Rig& rig, const State& state, std::size_t element, Workspace& workspace);

}  // namespace tendril::rig
