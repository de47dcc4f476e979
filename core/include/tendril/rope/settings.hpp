// Settings of a rope world's simulation.
//
// Time advances in fixed substeps, so a second has the same result however it is divided into frames. In each
// substep every free particle moves by Verlet integration, and is then corrected to satisfy distances, pins
// and colliders. There are three solvers for these corrections:
//
// * Relaxation satisfies one distance after the other, `iterations` times (T. Jakobsen, "Advanced Character
//   Physics", GDC 2001; M. Mueller et al., "Position Based Dynamics", 2007). How far a rope stretches then
//   depends on the iterations and on the substep.
// * Xpbd does the same with compliance: with enough iterations the stretch is physical (M. Macklin, M.
//   Mueller, N. Chentanez, "XPBD", 2016).
// * Direct solves all distances along a rope at once: their linearisation is tridiagonal, O(n) per pass. The
//   tension of the previous substep is applied implicitly, because it makes a fine rope stiff sideways (M.
//   Tournier et al., "Stable Constrained Dynamics", 2015), and it acts along the mean of the directions
//   before and after, which neither adds energy nor removes it (O. Gonzalez, "Mechanical systems subject to
//   holonomic constraints", 1999). A rope that touches colliders is solved together with its contacts and
//   their friction, by Newton's method: it keeps its length on a ball as it does in the air, with any number
//   of segments. So is a rope that resists bending, even in the air: its forces reach the next particle but
//   one, which costs about five times as much, and its swing dies away sooner. A cloth is one system with its
//   contacts: a backward Euler step (D. Baraff, A. Witkin, "Large Steps in Cloth Simulation", 1998) in which
//   the weight of the whole cloth stretches a link by 0.2 %. Each step of Newton's method is solved by
//   conjugate gradients with a multigrid cycle, so the iterations hardly grow with its resolution. A step
//   that strains links is halved until the incremental potential does not rise (M. Li et al., "Incremental
//   Potential Contact", 2020). Hair is solved strand by strand, and its contacts and bending between the
//   passes. Tied bodies take one such step together: ropes are solved exactly by elimination (A. George, J.
//   Liu, "The Evolution of the Minimum Degree Ordering Algorithm", 1989), cloths as above, with the forces of
//   their ties as further unknowns. Tied bodies cost at most twice as much as untied ones; but a cloth with
//   more than about four ties for each particle of a side is eliminated too, at a cost that grows with the
//   cube of its side. The swing of tied bodies dies away sooner.
//
// Direct adds no energy: a body that gained some in a substep is slowed down until the gain is gone, in its
// relative motion first, so that it keeps falling freely. Only moving colliders, pins and wind do work. Near
// a collider, Relaxation and Xpbd keep this bound too if the collider strikes the body or its links are
// within 0.1 % of their lengths; a link further off holds energy that the bound does not count.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tendril/fields.hpp"
#include "tendril/result.hpp"

namespace tendril::rope {

enum class Solver : std::uint8_t { Relaxation, Xpbd, Direct };
/// "relaxation", "xpbd", "direct"
const char* name(Solver solver) noexcept;

struct Settings {
    /// Seconds, min_substep to max_substep.
    double substep = 1.0 / 240.0;
    /// Passes in a substep, 1 to max_iterations. Direct ends as soon as it has converged. A cloth takes this
    /// many iterations of conjugate gradients in each of 2 to 6 steps of Newton's method; half as many if
    /// nothing touches or strains it.
    int iterations = 16;
    Solver solver = Solver::Direct;
    /// Decay rate of motion, 1/s, 0 to max_rate.
    float damping = 0.1f;
    /// m/s^2, each coordinate up to max_acceleration.
    glm::vec3 gravity{0.0f, -9.81f, 0.0f};
    float gravity_scale = 1.0f;  ///< -max_scale to max_scale
    /// Acceleration in addition to gravity, m/s^2.
    glm::vec3 external{0.0f};
    /// Velocity of the air, m/s, each coordinate up to max_wind. It pushes the faces of cloth, and ropes and
    /// hair by their thickness. Colliders do not block it. At 0 there is no air, unless `still_air` is set.
    glm::vec3 wind{0.0f};
    /// Maximum of gusts relative to the wind, in each coordinate, 0 to 1. Gusts are a fixed pattern that
    /// drifts with the wind (State::drift); a change of wind or substep does not shift it.
    float gusts = 0.3f;
    /// Whether air at rest has drag too: cloth then falls at the speed at which drag balances its weight.
    bool still_air = false;
    /// Strain per newton, 1/N, 0 to max_compliance: how much a metre of rope stretches under one newton.
    /// Relaxation ignores it.
    float compliance = 0.0f;
    /// Coulomb's friction coefficient between bodies and colliders, 0 to max_friction. A cloth held by
    /// friction on a slope still creeps by some millimetres per second.
    float friction = 0.5f;
    /// Maximum seconds that one call of advance() simulates, min_longest_frame to max_longest_frame; the rest
    /// is dropped.
    float longest_frame = 0.25f;

    bool operator==(const Settings&) const = default;
};

inline constexpr double min_substep = 1e-5, max_substep = 0.1;
inline constexpr int max_iterations = 10'000;
/// Limits the work of a substep: passes beyond the 16th are skipped (and counted) if all passes together
/// would take more links and contacts than this. Bodies that no link joins share it in proportion to size.
inline constexpr std::size_t max_pass_work = std::size_t{1} << 16;
inline constexpr int unbounded_passes = 16;
inline constexpr float max_rate = 1e3f, max_acceleration = 1e4f, max_wind = 1e3f, max_scale = 1e3f,
                       max_compliance = 1e3f, max_friction = 100.0f, min_longest_frame = 1e-3f,
                       max_longest_frame = 10.0f;

/// Refuses a setting out of range; the message names `operation`, the setting and its value.
Result check(const char* operation, const Settings& settings) noexcept;

}  // namespace tendril::rope

template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Settings>() noexcept;
