// Presets: chains of filters, each with an input and a plot that show its point.
#pragma once

#include <string>
#include <vector>

#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

struct SignalPreset {
    const char* name;
    const char* title;
    const char* point;  ///< things to notice and to try
    SignalPart (*make)();
};

/// The lab opens with the first one.
const std::vector<SignalPreset>& signal_presets();

}  // namespace tendril::app
