// Reports every elementary step of a solve as it happens, for programs that show or record them. Without an
// observer there is no cost: the solvers are compiled once with and once without one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tendril/vec3.hpp"

namespace tendril::ik {

enum class Phase : std::uint8_t {
    Prepare,           ///< lengths restored, blended towards rest, perturbed
    ForwardReaching,   ///< FABRIK: from the tip, which moves to the target, to the root
    BackwardReaching,  ///< FABRIK: from the root, which moves back to its position, to the tip
    Accelerate,        ///< accelerated FABRIK: scales all bends until the root-tip span fits
    Rotate,            ///< CCD: everything beyond one joint rotates about it
    Gradient,          ///< Jacobian solvers: all joints rotate a little at once
    Pole,              ///< the bend is swivelled to face the pole
    Limit,             ///< a joint is clamped to its limit
    Analytic,          ///< closed form: two bones, or a target out of reach or too close
    RestoreBest,       ///< restores the best pose, because the last one was worse
    Blend              ///< interpolates from the given pose: Options::weight
};
/// "forward_reaching"
const char* name(Phase phase) noexcept;

inline constexpr std::size_t no_joint = static_cast<std::size_t>(-1);

/// One joint moves. Steps with the same iteration, phase and `order` happen at once.
struct Step {
    int iteration = 0;  ///< from 1; 0 before the first
    Phase phase = Phase::Prepare;
    int order = 0;                     ///< counts the elementary steps of the solve from 0
    std::size_t joint = 0;             ///< the joint that moves
    std::size_t neighbour = no_joint;  ///< the joint whose distance is kept, or the centre of rotation
    glm::vec3 from{0.0f}, to{0.0f};    ///< metres
};

class Observer {
  public:
    virtual ~Observer() = default;
    /// Must not throw; may allocate.
    virtual void step(const Step& step) noexcept = 0;
    /// Called after each iteration, and with iteration 0 before the first.
    virtual void iteration_done(int iteration, float residual) noexcept = 0;
};

}  // namespace tendril::ik
