// Ready-made chains of filters, each with an input and a plot that make its point.
#pragma once

#include <string>
#include <vector>

#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

struct SignalPreset {
    const char* name;
    const char* title;
    const char* point;  ///< what to see there, and what to try
    SignalPart (*make)();
};

/// The first one is what the lab opens on.
const std::vector<SignalPreset>& signal_presets();

}  // namespace tendril::app
