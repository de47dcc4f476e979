// What became of what was asked for, in a few words: the first thing one reads in an inspector, and the
// largest.
#pragma once

#include <string>

#include "app/view/palette.hpp"

namespace tendril::app {

struct Verdict {
    std::string text;  ///< "Reached", "Out of reach: 0.23 m short", "Lengths off by 1.5 %"
    enum class Kind { Good, Bad, Open } kind = Kind::Open;
    std::string why{};  ///< what follows from it, or how to go on; a sentence
};

void show_verdict(const Verdict& said, const Palette& palette);

}  // namespace tendril::app
