// How what hangs on a character moves with it.
#pragma once

#include <tendril/rope/workspace.hpp>

#include "app/labs/humanoid/attachments/attachments.hpp"

namespace tendril::app {

/// Lets `seconds` pass, over 0: pins and colliders go evenly from where they were to where the wearer has
/// them now, and the world with them. What goes farther than a body can in that time has jumped.
void advance(Attachments& attachments, const Wearer& wearer, rope::Workspace& workspace, double seconds);

/// The wearer has jumped: everything goes along with its node, rigidly, and keeps its motion; what the body
/// would be in then is pushed aside. No time passes. Where no node has moved nothing does.
void carry(Attachments& attachments, const Wearer& wearer, rope::Workspace& workspace);

/// Whether nothing moves to speak of.
bool at_rest(const Attachments& attachments);

}  // namespace tendril::app
