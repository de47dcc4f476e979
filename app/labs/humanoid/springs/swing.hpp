// What the springs of a character do to its pose.
#pragma once

#include <memory>

#include "app/labs/humanoid/springs/springs.hpp"

namespace tendril::app {

/// Made for a character, one for each setting; null where the bone map leaves no room for it.
using SpringChains = std::vector<std::unique_ptr<humanoid::SpringChain>>;
using SpringStates = std::vector<humanoid::SpringChainState>;

/// Turns the nodes of the pose; with a dt of 0 no time passes.
std::vector<humanoid::SpringReport> swing(const std::vector<SpringSetting>& settings,
                                          const SpringChains& chains, double dt,
                                          std::vector<rig::Transform>& pose, SpringStates& states);
/// The pose was set, not reached in time.
void carry(const std::vector<SpringSetting>& settings, const SpringChains& chains,
           std::vector<rig::Transform> pose, SpringStates& states);
/// Whether hardly anything moves.
bool at_rest(const SpringStates& states);

}  // namespace tendril::app
