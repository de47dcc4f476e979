// The world of the Rope lab as a C++ program that uses the library.
#pragma once

#include <string>

#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

/// Complete program: the world without drags, simulated for one second in ticks of 1/60 s. Leaves out a
/// partial tick that is left over by slow motion or frame-time jitter.
std::string rope_code(const RopePart& part);

}  // namespace tendril::app
