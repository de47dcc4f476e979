// The list of the command palette: what a person reads first, what stands in a script behind it. In a window
// too narrow for both, one stands below the other; a word is never cut.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tendril::app {

struct PaletteRow {
    std::string title;   ///< "Add a joint at the tip"
    std::string where;   ///< the lab it belongs to, where that is another one
    std::string syntax;  ///< "chain.add length [position]"
    std::string keys;    ///< "Ctrl+Z"
    std::string help;
    bool done = false;  ///< nothing is to be chosen here any more
};

/// Its height for so many rows as it would like to show, in pixels.
float palette_list_height(const std::vector<PaletteRow>& rows, float width);

/// Fills the room that is left but for `below` pixels, with whole rows. Which one was clicked.
std::optional<std::size_t> palette_list(const std::vector<PaletteRow>& rows, int chosen,
                                        bool bring_choice_into_view, float below);

}  // namespace tendril::app
