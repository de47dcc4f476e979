// Presets: chains of filters, each with an input and a plot that show its point. Data in presets.json.
#pragma once

#include <string>
#include <vector>

#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

struct SignalPreset {
    std::string name, title;
    std::string point;  ///< things to notice and to try
    SignalPart part;
};

/// In the order of the panel. The lab opens with the first one.
const std::vector<SignalPreset>& signal_presets();

}  // namespace tendril::app
