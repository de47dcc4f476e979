// The world of the Rope lab as a C++ program against the library.
#pragma once

#include <string>

#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

/// A whole program: the world as it is, without what a drag holds, and a second of its time.
std::string rope_code(const RopePart& part);

}  // namespace tendril::app
