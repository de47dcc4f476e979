// Sections of a panel that fold to their title, and stay as one left them.
#pragma once

#include <string>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// A heading that folds what follows, by a click anywhere on it. Whether to show that. It is kept in the
/// settings, by the names of the lab and of the section.
[[nodiscard]] bool folding_section(const Workspace& workspace, const char* title, Emit& emit,
                                   bool open_at_first = true);

// The section of a lab's panel that opens a preset, empties the lab or resets it.

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

// What became of what was asked for, in a few words: the first thing one reads in an inspector, and the
// largest.

struct Verdict {
    std::string text;  ///< "Reached", "Out of reach: 0.23 m short", "Lengths off by 1.5 %"
    enum class Kind { Good, Bad, Open } kind = Kind::Open;
    std::string why{};  ///< what follows from it, or how to go on; a sentence
};

void show_verdict(const Verdict& said, const Palette& palette);

}  // namespace tendril::app
