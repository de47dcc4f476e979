// The constants of a body's solve, tuned by trial on real characters. The behaviour that each protects is
// tested in tests/core/humanoid_body*_test.cpp and humanoid_contact_test.cpp. All are per solve, not per
// second, because there is one solve per frame. Metres are for a figure of 1.8 m: a solve scales them by
// Body::Work::size. Not installed.
#pragma once

namespace tendril::humanoid::detail {

// Weights, relative to a target of weight 1.

/// Weight of a foot that stays where the clip has it.
inline constexpr double planted_foot_weight = 30.0;
/// Weight of a contact: a target 0.5 m out of reach presses capsules 2 mm into each other.
inline constexpr double contact_weight = 250.0;
/// Weight of the centre of mass, once it leaves the safe part of the support.
inline constexpr double balance_weight = 100.0;
/// A tilted foot that would sink this deep, in leg lengths, rolls over the end that would sink.
inline constexpr double rolling_part = 0.01;
/// Weight of a contact that would pull: almost none, so that its equation stays solvable.
inline constexpr double released_contact_weight = 1e-9;

// The step: damped least squares.

/// Mobility of the hips: square metres, relative to the square radians of an upper arm.
inline constexpr double hips_mobility = 0.004;
/// A step ignores capsules that are further apart than this, metres.
inline constexpr double contact_range = 0.15;
/// Stiffness of a limb that is straightened by a residual that does not shrink: the second derivative, which
/// Gauss-Newton drops. More than 1, because the joints of a limb turn together.
inline constexpr double residual_stiffness = 2.0;
/// Maximum changes of the active set, limits and contacts, per step.
inline constexpr int max_active_set_changes = 3;

// The trust region (Levenberg and Marquardt): damping is `lambda` times the residual times `damping_length`.

inline constexpr double first_lambda = 0.25, min_lambda = 0.01, max_lambda = 1e6;
inline constexpr double lambda_after_success = 0.5, lambda_after_failure = 8.0;  ///< factors
/// Range in which a linear step is valid: about half a limb, metres.
inline constexpr double damping_length = 0.5;
inline constexpr double min_damping = 1e-8;
inline constexpr double max_step_turn = 0.5;  ///< radians per joint and step
/// A step that changes the cost by less than this share has stalled, unless the cost is as small as
/// `min_stalled_cost`: then only a step below the tolerance ends the solve.
inline constexpr double stalled_share = 1e-5, min_stalled_cost = 1e-6;

// Relaxation: the joints turn back towards the clip's pose in the null space of the targets.

/// Maximum turn back in a solve, radians per metre that the goals have moved: a pose approaches the clip's
/// while its targets move, and does not jump there.
inline constexpr double relaxation_per_metre = 3.0;
/// The largest share of the way back to the clip's pose that a step takes. Halved by a step that fails,
/// doubled by one that succeeds.
inline constexpr double max_relaxed_share = 0.5;
/// Above this damping the targets have priority and relaxation shrinks in proportion.
inline constexpr double relaxing_damping = 1e-3;

// The speed limit: joints travel only so far in a solve.

/// Maximum travel, metres per metre that the goals have moved since the last solve.
inline constexpr double travel_per_metre = 12.0;
/// Fraction of the limit that the next solve keeps: it may have to catch up.
inline constexpr double travel_kept = 0.5;
inline constexpr double max_travel = 3.0;  ///< metres
/// A step cut to the limit may exceed it by this factor.
inline constexpr double travel_tolerance = 1.1;
inline constexpr int max_travel_cuts = 4;

/// Share of a contact's deflection that a limb without a target keeps in the next solve.
inline constexpr double deflection_kept = 0.7;

/// Sets the damping of the next step, for a residual scaled to 1.8 m.
class TrustRegion {
  public:
    double damping(double residual) const noexcept {
        const double value = lambda_ * damping_length * residual;
        return value > min_damping ? value : min_damping;
    }
    void succeeded() noexcept {
        lambda_ *= lambda_after_success;
        if (lambda_ < min_lambda) lambda_ = min_lambda;
    }
    void failed() noexcept {
        lambda_ *= lambda_after_failure;
        if (lambda_ > max_lambda) lambda_ = max_lambda;
    }

  private:
    double lambda_ = first_lambda;
};

/// Limits how far the next step may turn joints back towards the clip's pose.
class Relaxation {
  public:
    explicit Relaxation(double goals_moved) noexcept : budget_(relaxation_per_metre * goals_moved) {}

    double share(double damping) const noexcept {
        const double fits = relaxing_damping / damping;
        return share_ * (fits < 1.0 ? fits : 1.0);
    }
    double budget() const noexcept { return budget_; }  ///< remaining radians
    void succeeded(double turned) noexcept {
        budget_ = budget_ - turned > 0.0 ? budget_ - turned : 0.0;
        share_ = share_ * 2.0 < max_relaxed_share ? share_ * 2.0 : max_relaxed_share;
    }
    void failed() noexcept { share_ *= 0.5; }

  private:
    double share_ = max_relaxed_share;
    double budget_;
};

}  // namespace tendril::humanoid::detail
