// Where a control that follows a path is.
#pragma once

#include <tendril/rig/control.hpp>

#include "app/labs/rig/rig_take.hpp"

namespace tendril::app {

/// Whether a control of that kind can follow one.
bool can_walk(rig::ControlKind kind);
/// After so many ticks of the take, which need not be whole; within the control's space.
glm::dvec3 walk_point(const Motion& motion, double ticks);
/// The value of the control there: what the path does not say is as `now` has it.
rig::Value walk_value(const RigWalk& walk, const rig::Value& now, double ticks);

}  // namespace tendril::app
