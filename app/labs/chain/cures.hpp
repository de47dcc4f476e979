// What helps a chain that stalls or flips, as commands for a button.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "app/document/incident.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/flips.hpp"

namespace tendril::app {

/// A new pole target is beside the middle of the line from head to tail, on the side to which the chain
/// bends, so that adding it turns nothing. A straight chain gets it above.
glm::vec3 first_pole(const ChainPart& part);

/// Whether all joints lie on the line from the root to the target.
bool in_line_with_target(const ChainPart& part);

/// For a solve that ended short of a target within reach; none if its report names none.
std::optional<Cure> reach_cure(const ChainPart& part);

/// For a flip between two ticks.
std::optional<Cure> flip_cure(FlipCure cure, const ChainPart& before, const ChainPart& after);

}  // namespace tendril::app
