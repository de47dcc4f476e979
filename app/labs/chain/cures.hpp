// Remedies for a chain that stalls or flips, as commands for a button.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "app/document/incident.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/flips.hpp"

namespace tendril::app {

/// The initial pole target: beside the middle of the line from head to tail, on the side to which the chain
/// bends, so that adding it rotates nothing. Above a straight chain.
glm::vec3 first_pole(const ChainPart& part);

/// Whether all joints lie on the line from the root to the target.
bool in_line_with_target(const ChainPart& part);

/// The remedy for a solve that ended short of a target within reach, if there is one.
std::optional<Cure> reach_cure(const ChainPart& part);

/// The remedy for a flip between two ticks, if there is one.
std::optional<Cure> flip_cure(FlipCure cure, const ChainPart& before, const ChainPart& after);

}  // namespace tendril::app
