// What comes out of a solve.
#pragma once

#include <cstdint>

namespace tendril::ik {

/// How a solve ended.
enum class Status : std::uint8_t {
    Converged,       ///< the tip is within tolerance of the target
    Stretched,       ///< the target is out of reach and the chain lies straight towards it; or the soft zone
                     ///< keeps it short of the target by more than the tolerance
    TooClose,        ///< the target is nearer than the longest bone lets the tip fold
    Limited,         ///< the joint limits keep the tip away: a descent within them ends short of the target,
                     ///< at limits without which it would go on. By another way there may be one that arrives
    Stalled,         ///< further iterations of this method would change nothing, and no limit is to blame
    IterationLimit,  ///< still on its way when the iterations were used up
    InvalidInput     ///< a number that is not finite or out of range: nothing was moved
};
/// "Converged"
const char* name(Status status) noexcept;

/// How a solve ended, and what really ran.
struct Report {
    Status status = Status::Converged;
    int iterations = 0;
    float residual = 0.0f;  ///< metres from the tip to the target
    /// The answer, or what the iterations started from, was worked out in closed form: two bones, or a target
    /// out of reach or too close.
    bool closed_form = false;
    int perturbations = 0;  ///< times the chain was bent a little, to leave a pose from which no way led on
    int least_squares_steps = 0;  ///< iterations within limits that took such a step beside the method's own
    int restarts = 0;             ///< other poses that the solve started from again
    bool operator==(const Report&) const = default;
};

}  // namespace tendril::ik
