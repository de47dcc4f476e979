// Steps that a body takes when shifting its hips does not keep it balanced.
//
//     FootstepsState steps;  // persists from frame to frame
//     // In each frame, with `placed` from the clip's pose and `solved` from the one of the last lines:
//     options.feet = advance_steps(steps, *soles, dt);
//     body->solve(pose, targets, body_state, options);
//     place(skeleton, pose, solved);
//     plan_step(steps, *soles, masses->centre(solved), placed, body_state, options.ground);
//
// The body falls towards its capture point: its centre of mass, shifted by the largest remaining error of a
// target (hands, head, hips), clamped to 0.5 to 0.9 of the leg's length. (J. Pratt et al., "Capture point: a
// step toward humanoid push recovery", 2006, for a body that moves slowly.) The foot nearer to that point
// steps under it, at most 0.9 of the leg's length from the other foot, and never across; the other one
// follows if one step is not enough. Without targets, the feet step back to where the clip has them.
//
// Moving a hand at 1 m/s to a target within 1.9 m takes two steps or fewer in most cases, four in nearly all.
//
// Needs a clip that stands: while the clip lifts a foot, no step begins.
//
// Cost: under a microsecond.
#pragma once

#include <array>
#include <span>

#include "tendril/humanoid/body.hpp"
#include "tendril/humanoid/soles.hpp"

namespace tendril::humanoid {

/// Targets missed by less than this need no step, as a fraction of the leg's length.
inline constexpr double no_step_within = 0.02;

struct FootstepOptions {
    double seconds = 0.3;  ///< duration of a step: 0.05 to 5
    double lift = 0.1;     ///< height of its arc, in leg lengths: 0 to 1
    bool operator==(const FootstepOptions&) const = default;
};

/// A foot's shift from its place in the clip, metres.
struct Footstep {
    glm::dvec3 from{0.0}, to{0.0};
    double part = 1.0;  ///< progress from `from` to `to`: 0 to 1
    bool operator==(const Footstep&) const = default;
};

struct FootstepsState {
    std::array<Footstep, 2> feet{};  ///< left, right
    /// True while a foot is in the air.
    bool stepping() const noexcept { return feet[0].part < 1.0 || feet[1].part < 1.0; }
    /// True if a foot is away from its place in the clip, or on its way there or back.
    bool away() const noexcept { return *this != FootstepsState(); }
    bool operator==(const FootstepsState&) const = default;
};
/// For a state read from a file: refuses numbers that are not finite, over 1e9, or parts outside 0 to 1.
Result check(const FootstepsState& state) noexcept;

/// Moves the stepping foot on by `dt` seconds; it stays if dt is not over 0. Returns BodyOptions::feet.
/// Options out of range are clamped, and a state that check() refuses is reset.
std::array<FootShift, 2> advance_steps(FootstepsState& state, const Soles& soles, double dt,
                                       const FootstepOptions& options = {}) noexcept;

/// Begins a step if none is under way and one is needed: in the last solve, which left `body`, balance or a
/// stretched leg held the body back from a target. `clip`: placements of the pose before the solve. With
/// `ground`, a foot steps only onto ground, at most 0.5 of the leg's length up or down from where it stands.
/// Returns whether a step began.
bool plan_step(FootstepsState& state, const Soles& soles, const glm::dvec3& centre,
               std::span<const Placement> clip, const BodyState& body,
               const Ground* ground = nullptr) noexcept;

}  // namespace tendril::humanoid

template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::FootstepOptions>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::Footstep>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::FootstepsState>() noexcept;
