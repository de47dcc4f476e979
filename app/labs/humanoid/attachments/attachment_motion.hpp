// How what hangs on a character moves with it.
#pragma once

#include <tendril/rope/workspace.hpp>

#include "app/document/command.hpp"
#include "app/labs/humanoid/attachments/attachments.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"

namespace tendril::app {

/// Lets `seconds` pass, over 0: pins and colliders go evenly from where they were to where the wearer has
/// them now, and the world with them. What goes farther than a body can in that time has jumped.
void advance(Attachments& attachments, const Wearer& wearer, rope::Workspace& workspace, double seconds);

/// The wearer has jumped: everything goes along with its node, rigidly, and keeps its motion; what the body
/// would be in then is pushed aside. No time passes. Where no node has moved nothing does.
void carry(Attachments& attachments, const Wearer& wearer, rope::Workspace& workspace);

/// Whether nothing moves to speak of.
bool at_rest(const Attachments& attachments);

// What hangs on the lab's character goes along with what commands and ticks do to it.

/// As long as `shown` is there, and the part is not changed.
Wearer wearer_of(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown);

/// The same command; whatever it does to the pose, springs and what hangs on the character are carried along
/// at once. What drags do while time passes is left to the next tick, which swings them.
Command carrying(Command command);

/// After the character became so many times as large.
void remake_attachments(Workspace& workspace, double scale);

}  // namespace tendril::app
