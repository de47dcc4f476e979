// Every elementary step of a solve, as it happens: for a program that shows or records them. Without an
// observer this costs nothing: the solvers are compiled once with and once without it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tendril/vec3.hpp"

namespace tendril::ik {

enum class Phase : std::uint8_t {
    Prepare,           ///< lengths restored, blended towards rest, perturbed
    ForwardReaching,   ///< FABRIK: from the tip, which goes to the target, to the root
    BackwardReaching,  ///< FABRIK: from the root, which goes back to its place, to the tip
    Accelerate,        ///< accelerated FABRIK: all bends are made less or more until the root-tip span fits
    Rotate,            ///< CCD: everything beyond one joint rotates about it
    Gradient,          ///< Jacobian solvers: all joints rotate a little at once
    Pole,              ///< the bend is swivelled to face the pole
    Limit,             ///< a joint is brought back into its limit
    Analytic,          ///< the answer at once: two bones, a target out of reach or too close
    RestoreBest,       ///< the pose nearest to the target is restored, for the last one was worse
    Blend              ///< part of the way from the given pose: Options::weight
};
/// "forward_reaching"
const char* name(Phase phase) noexcept;

inline constexpr std::size_t no_joint = static_cast<std::size_t>(-1);

/// One joint goes from one place to another. Steps with the same iteration, phase and `order` happen at once.
struct Step {
    int iteration = 0;  ///< from 1; 0 before the first
    Phase phase = Phase::Prepare;
    int order = 0;                     ///< counts the elementary steps of the solve from 0
    std::size_t joint = 0;             ///< which one moves
    std::size_t neighbour = no_joint;  ///< at whose distance it is placed, or about which it turns
    glm::vec3 from{0.0f}, to{0.0f};    ///< metres
};

class Observer {
  public:
    virtual ~Observer() = default;
    /// Must not throw; may allocate.
    virtual void step(const Step& step) noexcept = 0;
    /// After each iteration, and with iteration 0 before the first.
    virtual void iteration_done(int iteration, float residual) noexcept = 0;
};

}  // namespace tendril::ik
