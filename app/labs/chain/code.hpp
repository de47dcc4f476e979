// Export: a chain, how it follows its target and with what, as a program against tendril::core.
#pragma once

#include <string>

#include "app/labs/chain/chain_part.hpp"

namespace tendril::app {

/// A whole C++ program. It makes the very chain that is here (while a solve is studied: the one that every
/// solve starts from), does once what moving the target does, and prints where each segment came to lie, in
/// digits that read back as the same floats.
std::string chain_code(const ChainPart& part);

}  // namespace tendril::app
