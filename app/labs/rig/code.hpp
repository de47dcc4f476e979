// The rig as a C++ program against the library.
#pragma once

#include <string>

#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// A whole program: makes the rig, sets it as it is set here, solves, and prints every element's global pose,
/// the same as here.
std::string rig_code(const RigPart& part);

}  // namespace tendril::app
