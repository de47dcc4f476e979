// Export: the chain of filters as a C++ program that uses the library.
#pragma once

#include <string>

#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

/// A complete program: the enabled filters, stepped frame by frame through one second after a jump.
std::string signal_code(const SignalPart& part);

}  // namespace tendril::app
