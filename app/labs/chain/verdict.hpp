// What became of the last move of the target, in a few words: the first thing one reads.
#pragma once

#include <string>

#include "app/labs/chain/chain_part.hpp"

namespace tendril::app {

struct Verdict {
    std::string text;  ///< "Reached", "Out of reach: 0.23 m short", "Limited by joint 1: 0.10 m short"
    enum class Kind { Good, Bad, Open } kind = Kind::Open;
};
Verdict chain_verdict(const ChainPart& part);

}  // namespace tendril::app
