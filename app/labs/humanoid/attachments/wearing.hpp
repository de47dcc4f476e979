// What hangs on the lab's character goes along with what commands and ticks do to it.
#pragma once

#include "app/document/command.hpp"
#include "app/labs/humanoid/attachments/attachment_motion.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"

namespace tendril::app {

/// As long as `shown` is there, and the part is not changed.
Wearer wearer_of(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown);

/// The same command; whatever it does to the pose, springs and what hangs on the character are carried along
/// at once. What drags do while time passes is left to the next tick, which swings them.
Command carrying(Command command);

/// After the character became so many times as large.
void remake_attachments(Workspace& workspace, double scale);

}  // namespace tendril::app
