// Backward solve: finds the control values that give the bones' current pose, such as an imported
// animation's.
//
// Minimises, over the values of all controls within their limits, the squared differences between each bone's
// global pose and the wanted one, starting from the current control values. Method: Levenberg-Marquardt (D.
// W. Marquardt, "An algorithm for least-squares estimation of nonlinear parameters", SIAM 11(2), 1963) with
// derivatives from finite differences of forward solves, so no unit needs an inverse. Bool controls are tried
// both ways, one after the other. Springs are taken to be at rest.
//
// A difference that the rig cannot express remains as the residual of a bone.
//
// Cost: some ten iterations. Each takes one forward solve per number of the controls (a transform has nine)
// and factors a square matrix of that size. Milliseconds for ten transform controls; seconds for a chain of
// 180, see max_work. Allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/rig/workspace.hpp"

namespace tendril::rig {

struct BackwardOptions {
    int max_iterations = 100;  ///< per descent, of which each bool control adds one; clamped to 1 to 10 000
    /// Metres that weigh as much as one radian or a scale difference of 1; 0 or less: the rig's mean bone
    /// length.
    double metres_per_radian = 0.0;
    /// Maximum work over all descents, in the steps of Rig::work; 0: no limit. Counted, not timed, so a solve
    /// that hits it gives the same result on every machine.
    std::uint64_t max_work = 0;
};

/// The remaining difference of one bone.
struct Residual {
    double metres = 0.0, radians = 0.0;
    double scale = 0.0;  ///< largest difference of a component
};

struct BackwardReport {
    std::vector<Residual> elements{};  ///< in the order of Definition::elements; 0 for non-bones
    /// The bone with the largest residual, weighted as in the solve; none in a rig without bones.
    std::optional<std::size_t> worst{};
    int iterations = 0;  ///< in the last descent
    int solves = 0;      ///< forward solves in total
    /// Whether max_iterations or max_work ended the solve: better values may exist. With 0 iterations the
    /// controls are unchanged.
    bool stopped = false;
};

/// The differences between the bones of two states of one rig.
std::vector<Residual> residuals(const Rig& rig, State& state, State& wanted);

/// Sets the controls so that a forward solve gives the current pose of the bones as closely as possible, and
/// solves. The bones then follow the controls. Clears the units' memory.
BackwardReport solve_backward(const Rig& rig, State& state, Workspace& workspace,
                              const BackwardOptions& options = {});

}  // namespace tendril::rig

template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::BackwardOptions>() noexcept;
