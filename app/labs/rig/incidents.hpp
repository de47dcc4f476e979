// What a person may ask about that came of a tick or a change: bones that flipped, units that report
// something, controls at their limits.
#pragma once

#include <vector>

#include "app/document/incident.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// Of two states of one rig, as the Rig lab reviews them. Flips, of each unit's the bone that turned the
/// furthest, are counted between two solves, where nothing but controls was set in between.
std::vector<Incident> rig_incidents(const RigPart& before, const RigPart& after);

}  // namespace tendril::app
