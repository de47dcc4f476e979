// The section of a lab's panel that opens a preset, empties the lab or resets it.
#pragma once

#include <string>
#include <vector>

#include "app/widgets/emit.hpp"

namespace tendril::app {

struct PresetButton {
    std::string name;  ///< as the command has it
    std::string title;
    std::string tooltip{};
    int of = 0;  ///< buttons to its row; 0: as the others
};

/// Emits the lab's preset, clear and reset commands: "chain.preset" and so on. `clears` says what Empty
/// removes. True where a preset was opened.
/// `of`: buttons to a row.
bool preset_rows(const std::string& lab, const std::vector<PresetButton>& presets, const char* clears,
                 Emit& emit, int of = 3);

}  // namespace tendril::app
