// The contents of a workspace. Not installed.
#pragma once

#include <optional>
#include <vector>

#include "tendril/ik/curve.hpp"
#include "tendril/ik/solver.hpp"
#include "tendril/rig/workspace.hpp"

namespace tendril::rig {

/// Scratch of a unit that solves or places a chain.
struct ChainScratch {
    std::optional<ik::Solver> solver;
    std::vector<float> lengths;  ///< the lengths that the solver was made for
    std::vector<glm::vec3> joints;
    std::vector<glm::dquat> rotations_before;  ///< local rotations
    // for splines
    std::vector<glm::vec3> points, rest_directions;  ///< from the first point; the bones' initial directions
    ik::State placed;
    ik::CurveMemory curve_memory;
};

struct Workspace::Parts {
    std::vector<ChainScratch> chains;  ///< one per unit; empty unless it solves a chain
    std::vector<ConstraintParent> parents;
};

}  // namespace tendril::rig
