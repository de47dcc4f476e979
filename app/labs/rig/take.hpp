// Advances a take: tick by tick, to any tick, and into a new take. Also the paths that controls follow.
#pragma once

#include <tendril/rig/control.hpp>

#include "app/labs/rig/rig_part.hpp"
#include "app/labs/rig/rig_runtime.hpp"

namespace tendril::app {

/// Starts a new take at the current time, because later states no longer follow from the take.
void begin_take(RigPart& part);
/// Ends a recording if `part` has left its take since `before`: keeps the clip, and says so.
void keep_recording(Workspace& workspace, RigPart& part, const RigPart& before);
/// Records that the control was set after the current tick. Discards the later keys.
void key_control(RigPart& part, std::size_t element);
/// Solves with a zero time step. If that changes anything, records it in the take and discards the later
/// keys. Several solves at one tick, with controls set in between, give the same result as setting everything
/// first and solving once.
void solve_now(RigPart& part, RigRuntime& runtime, bool measured);

/// True if a tick would change anything.
bool time_moves(const RigPart& part);
void pass_tick(RigPart& part, RigRuntime& runtime, bool measured);
/// Goes to any tick of the take, or past its end, with the same result as playing to it. Throws
/// std::invalid_argument if that would take too long.
void go_to(RigPart& part, std::uint32_t tick, RigRuntime& runtime);

/// Runs a separate state through the take, without changing the part.
class TakeRunner {
  public:
    /// Starts at the beginning of the take.
    TakeRunner(const RigPart& part, rig::Workspace& scratch);
    /// Advances by a frame of `seconds`, which ends `ticks` after the start of the take (may be fractional).
    void frame(double seconds, double ticks);
    rig::State& state() { return state_; }

  private:
    void keys_before(double ticks);

    const RigPart& part_;
    rig::Workspace& scratch_;
    rig::State state_;
    std::size_t next_key_ = 0;
};

// Positions on the paths that controls follow.

/// True if controls of this kind can follow a path.
bool can_walk(rig::ControlKind kind);
/// The position `ticks` after the start of the take (may be fractional), within the control's space.
glm::dvec3 walk_point(const Motion& motion, double ticks);
/// The control's value there; components that the path does not set come from `now`.
rig::Value walk_value(const RigWalk& walk, const rig::Value& now, double ticks);

}  // namespace tendril::app
