// What became of the last move of the target, in a few words: the first thing one reads.
#pragma once

#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/verdict.hpp"

namespace tendril::app {

/// "Reached", "Out of reach: 0.23 m short", "Limited by joint 1: 0.10 m short".
Verdict chain_verdict(const ChainPart& part);

}  // namespace tendril::app
