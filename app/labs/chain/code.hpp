// Export: the chain, its mode and its options as a C++ program that uses tendril::core.
#pragma once

#include <cstddef>
#include <string>

#include "app/labs/chain/chain_part.hpp"

namespace tendril::app {

/// A complete C++ program. It builds the chain (while a study is open, its start), moves it once to the
/// target as the lab does, and prints the position of each segment exactly.
std::string chain_code(const ChainPart& part);

/// Longer lists are written as tables of plain numbers: shorter, and fast to compile.
inline constexpr std::size_t max_listed = 64;

}  // namespace tendril::app
