// Explains an element's pose: the change that each unit made to it in a forward solve, in order.
#pragma once

#include <cstddef>
#include <vector>

#include "tendril/rig/workspace.hpp"

namespace tendril::rig {

/// From one global pose to the next: `after` is compose(before, change), to rounding.
struct Contribution {
    Transform before{}, after{}, change{};
    double metres = 0.0;   ///< distance moved
    double radians = 0.0;  ///< angle turned
};

struct Explanation {
    Transform input{};                  ///< before the first unit
    std::vector<Contribution> units{};  ///< one per unit of Definition::units, in order
    Transform result{};                 ///< after the last unit
};

/// Solves a copy of the state with dt = 0. Cost: one solve plus one read per unit; allocates. `element` is an
/// index into Definition::elements.
Explanation explain(const Rig& rig, const State& state, std::size_t element, Workspace& workspace);

}  // namespace tendril::rig
