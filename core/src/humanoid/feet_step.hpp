// The stages of a step of Feet. Not installed.
#pragma once

#include <algorithm>

#include "humanoid/feet.hpp"
#include "humanoid/foot.hpp"

namespace tendril::humanoid::detail {

/// A foot this close to the ground stands, metres. The distance includes the part that its leg cannot reach.
inline constexpr double max_gap = 0.003;

/// Advances a critically damped spring.
inline double step_spring(signal::SpringState<double>& spring, double half_life, double target,
                          double dt) noexcept {
    const double strength = math::ln2 / (math::pi * half_life);
    return signal::step({.strength = strength, .critical_damping = 1.0}, spring, target, dt);
}
/// Overrides a spring's value. Its velocity follows from the change, or stays if dt is 0.
inline void set(signal::SpringState<double>& spring, double before, double value, double dt) noexcept {
    spring.value = value;
    if (dt > 0.0) spring.velocity = (value - before) / dt;
}
inline double move_toward(double from, double to, double most) noexcept {
    return std::clamp(to, from - most, from + most);
}

class FeetStep {
  public:
    FeetStep(const FeetPlan& plan, Pose pose, const Ground& ground, double dt, FeetState& state,
             const FeetOptions& options) noexcept
        : plan_(plan),
          pose_(pose),
          ground_(ground),
          dt_(dt > 0.0 ? std::min(dt, signal::max_dt) : 0.0),
          state_(state),
          options_(options) {}

    /// False if the pose is not finite.
    bool place() noexcept;
    // Then, in this order:
    void raise_root() noexcept;
    void find_feet() noexcept;
    void lower_pelvis() noexcept;
    void limit_standing_knees() noexcept;
    void move() noexcept;
    FeetReport report() const noexcept;

  private:
    void point_knees() noexcept;
    bool has_jumped() const noexcept;
    bool is_ground(const std::optional<GroundHit>& hit, double around) const noexcept;
    double first_base() const noexcept;
    double ground_around() const noexcept;
    double shortfall(std::size_t leg, double lift) const noexcept;
    double shortfall(std::size_t leg, double lift, double longest) const noexcept;
    double lift_limit(std::size_t leg) const noexcept;
    void ease_lift(std::size_t leg, double goal, double rise) const noexcept;
    glm::dvec3 target(std::size_t leg, double lift) const noexcept;
    double knee_speed(std::size_t leg, double raise, double lift) const noexcept;
    bool is_standing(std::size_t leg) const noexcept {
        return state_.feet[leg].standing && state_.feet[leg].locked;
    }
    void stay_above(std::size_t leg) noexcept;
    void limit_knee(std::size_t leg, double raise) noexcept;

    const FeetPlan& plan_;
    Pose pose_;
    const Ground& ground_;
    double dt_;
    FeetState& state_;
    const FeetOptions& options_;
    bool first_step_ = false;
    double floor_ = 0.0, steepest_ = 0.0;
    Placement above_hips_, hips_;
    std::array<LimbPlacement, 2> legs_;
    std::array<FootClip, 2> clips_;
    std::array<FootGoal, 2> goals_;
    std::array<glm::dvec3, 2> knees_, poles_;  // the clip's knees; the directions in which knees point
    double last_raise_ = 0.0;                  // lift of the hips before the step
    std::array<double, 2> lifts_{};            // before the step
    std::array<double, 2> shortfalls_{};       // distance of the leg's end from its target
};

}  // namespace tendril::humanoid::detail
