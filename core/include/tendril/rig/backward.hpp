// Backward solve: which control values give the pose that the bones have, as an imported animation has it.
//
// The answer is the least squares, over the values of all controls within their limits, of what is left
// between each bone's global pose and the one asked for, from the values that the controls have now: a
// Levenberg-Marquardt descent (D. W. Marquardt, "An algorithm for least-squares estimation of nonlinear
// parameters", SIAM 11(2), 1963) whose derivatives are differences of forward solves. Whatever the units are,
// no unit needs an inverse. Bool controls are tried both ways, one after the other. What remembers (springs)
// counts as having come to rest.
//
// What a rig cannot express is left over, and said bone by bone.
//
// Cost: some ten times as many forward solves as there are numbers in the controls, of which a transform has
// nine, and as many matrices of that size. Milliseconds for ten transform controls; for 180 one above the
// other seconds, see max_work. Allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tendril/rig/workspace.hpp"

namespace tendril::rig {

struct BackwardOptions {
    int max_iterations = 100;  ///< for each way that the bool controls stand; taken as 1 to 10 000
    /// Metres that count as much as a radian, and as a scale of 1; 0 or less: the mean length of the rig's
    /// bones.
    double metres_per_radian = 0.0;
    /// The most work, in the steps of Rig::work, over all ways that the bool controls stand; 0: any amount.
    /// It is counted and not timed, so that a solve that it ends comes out the same everywhere.
    std::uint64_t max_work = 0;
};

/// What is left of one bone.
struct Residual {
    double metres = 0.0, radians = 0.0;
    double scale = 0.0;  ///< the largest difference of a component
};

struct BackwardReport {
    std::vector<Residual> elements{};  ///< in the order of Definition::elements; 0 of what is no bone
    /// The bone with the most left, metres and radians together; none in a rig without bones.
    std::optional<std::size_t> worst{};
    int iterations = 0;  ///< of the last descent
    int solves = 0;      ///< forward solves, in all
    /// max_iterations or max_work ended it: there may be values that come nearer. With no iterations done the
    /// controls are as they were.
    bool stopped = false;
};

/// What is left between the bones of two states of one rig.
std::vector<Residual> residuals(const Rig& rig, State& state, State& wanted);

/// Sets the controls so that a forward solve leads to the current pose of the bones, as nearly as it can, and
/// solves: the bones are then where the controls have them. What units remember begins anew.
BackwardReport solve_backward(const Rig& rig, State& state, Workspace& workspace,
                              const BackwardOptions& options = {});

}  // namespace tendril::rig
