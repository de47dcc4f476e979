// The list of the command palette: titles, followed by the script syntax. In a window too narrow for both,
// the syntax is below the title; words are never cut.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tendril::app {

struct PaletteRow {
    std::string title;   ///< "Add a joint at the tip"
    std::string where;   ///< its lab, if not the open one
    std::string syntax;  ///< "chain.add length [position]"
    std::string keys;    ///< "Ctrl+Z"
    std::string help;
    bool done = false;  ///< already given: nothing to choose
};

/// The preferred height for these rows, in pixels.
float palette_list_height(const std::vector<PaletteRow>& rows, float width);

/// Fills the remaining height, except for `below` pixels, with whole rows. Returns the clicked row.
std::optional<std::size_t> palette_list(const std::vector<PaletteRow>& rows, int chosen,
                                        bool bring_choice_into_view, float below);

}  // namespace tendril::app
