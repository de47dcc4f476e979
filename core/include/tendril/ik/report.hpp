// Output of a solve.
#pragma once

#include <cstdint>
#include <span>

#include "tendril/fields.hpp"

namespace tendril::ik {

/// How a solve ended.
enum class Status : std::uint8_t {
    Converged,       ///< the tip is within tolerance of the target
    Stretched,       ///< the target is out of reach and the chain lies straight towards it; or the soft zone
                     ///< keeps the tip short of it by more than the tolerance
    TooClose,        ///< the target is closer than the chain can fold, because of its longest bone
    Limited,         ///< the joint limits stop the tip: descent ends short of the target, at limits without
                     ///< which it would continue. A pose elsewhere may still reach it
    Stalled,         ///< further iterations of this method would change nothing, and no limit is to blame
    IterationLimit,  ///< not converged when the iterations were used up
    InvalidInput     ///< a number is not finite or out of range: nothing was moved
};
/// "Converged"
const char* name(Status status) noexcept;

/// How a solve ended, and what it did.
struct Report {
    Status status = Status::Converged;
    int iterations = 0;
    float residual = 0.0f;  ///< metres from the tip to the target; infinite if the input was refused
    /// The result, or the start of the iterations, was found in closed form: two bones, or a target out of
    /// reach or too close.
    bool closed_form = false;
    int perturbations = 0;        ///< times the chain was perturbed to leave a stalled or collinear pose
    int least_squares_steps = 0;  ///< iterations within limits that took such a step
    int restarts = 0;             ///< restarts from other poses
    float off_plane = 0.0f;       ///< metres from the target to the plane of the chain, if it has one
    Result accepted{};            ///< why the status is InvalidInput: the argument and its value
    bool operator==(const Report&) const = default;
};

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Report>() noexcept;
