// The chain of filters as a C++ program against the library.
#pragma once

#include <string>

#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

/// A whole program: the filters that are on, and a frame's step for a second of a jump.
std::string signal_code(const SignalPart& part);

}  // namespace tendril::app
