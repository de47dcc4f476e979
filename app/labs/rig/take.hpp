// How a take goes on: tick by tick, to any tick, and where another begins.
#pragma once

#include <tendril/rig/control.hpp>

#include "app/labs/rig/rig_part.hpp"
#include "app/labs/rig/rig_runtime.hpp"

namespace tendril::app {

/// What comes now does not follow from the take so far: another begins here, and time goes on.
void begin_take(RigPart& part);
/// The control has been set, after the present tick: what was known to come is forgotten.
void key_control(RigPart& part, std::size_t element);
/// Solves without any time passing. Where that changes anything the take remembers it, and what was known to
/// come is forgotten. However often that is done at a tick, with whatever set in between, it comes out as if
/// all had been set at once and then solved.
void solve_now(RigPart& part, RigRuntime& runtime, bool measured);

/// Whether a tick would change anything.
bool time_moves(const RigPart& part);
void pass_tick(RigPart& part, RigRuntime& runtime, bool measured);
/// To a tick of the take, as playing there would; later ones too. Throws std::invalid_argument where that
/// would take too long.
void go_to(RigPart& part, std::uint32_t tick, RigRuntime& runtime);

/// A state on its way through a take, in other hands than the part's.
class TakeRunner {
  public:
    /// From the take's start.
    TakeRunner(const RigPart& part, rig::Workspace& scratch);
    /// A frame of `seconds`, at whose end so many `ticks` of the take have passed, whole or not.
    void frame(double seconds, double ticks);
    void tick();  ///< as pass_tick
    rig::State& state() { return state_; }

  private:
    void keys_before(double ticks);
    void apply(const TakeKey& key);

    const RigPart& part_;
    rig::Workspace& scratch_;
    rig::State state_;
    std::uint32_t ticks_ = 0;
    std::size_t next_key_ = 0;
};

// Where a control that follows a path is.

/// Whether a control of that kind can follow one.
bool can_walk(rig::ControlKind kind);
/// After so many ticks of the take, which need not be whole; within the control's space.
glm::dvec3 walk_point(const Motion& motion, double ticks);
/// The value of the control there: what the path does not say is as `now` has it.
rig::Value walk_value(const RigWalk& walk, const rig::Value& now, double ticks);

}  // namespace tendril::app
