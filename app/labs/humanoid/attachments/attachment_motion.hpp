// Moves a character's attachments with it.
#pragma once

#include <tendril/rope/workspace.hpp>

#include "app/document/command.hpp"
#include "app/labs/humanoid/attachments/attachments.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"

namespace tendril::app {

/// Advances the attachments by `seconds` > 0. Pins and colliders move evenly to the wearer's current pose
/// while the world is simulated. A wearer that moved implausibly far is treated as a jump; see carry().
void advance(Attachments& attachments, const Wearer& wearer, rope::Workspace& workspace, double seconds);

/// For a wearer that has jumped: moves each attachment rigidly with its node, keeping its motion, and pushes
/// it out of the body. No time passes. Does nothing if no node moved.
void carry(Attachments& attachments, const Wearer& wearer, rope::Workspace& workspace);

/// Whether everything moves negligibly slowly, and no gusts go on.
bool at_rest(const Attachments& attachments);

// Attachments of the lab's character, for commands and ticks.

/// Valid while `shown` exists and the part does not change.
Wearer wearer_of(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown);

/// Wraps a command so that springs and attachments are carried along with whatever it does to the pose. Drags
/// while the simulation runs are left to the next tick, which swings them.
Command carrying(Command command);

/// Call after the character was scaled by `scale`.
void remake_attachments(Workspace& workspace, double scale);

}  // namespace tendril::app
