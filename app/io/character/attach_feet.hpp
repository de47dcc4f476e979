// Repairs feet of IK rigs that hang outside the legs.
#pragma once

#include "app/io/character/character.hpp"

namespace tendril::app {

/// Moves feet that hang outside the legs below them (tendril/humanoid/attach.hpp), where that changes no
/// motion, and notes what was done or why not.
void attach_feet(Character& character);

}  // namespace tendril::app
