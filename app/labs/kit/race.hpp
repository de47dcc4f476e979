// Shared by the races of two labs: several solvers of one scene, each with a colour, and their numbers as
// CSV.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>

#include "app/document/command.hpp"
#include "app/document/workspace.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

inline constexpr std::size_t max_racers = 7;

/// The colour of a racer in view, panel and curves; racers also differ in lightness.
glm::vec3 racer_colour(const Palette& palette, std::size_t racer);

/// Small text at the right end of a line, cut to fit.
void small_right(const std::string& text);

/// The commands "<race>.copy" and "<race>.save", to the clipboard and to a file.
struct RaceCsv {
    std::string race;                       ///< "race", "rope.race"
    std::string title;                      ///< after "Copy" and "Save": "the race as CSV"
    std::string holds;                      ///< "tip to target in metres, for every solver and iteration,"
    std::string (*text)(const Workspace&);  ///< throws Refused if no race is open
};
void add_race_csv_commands(CommandTable& table, const RaceCsv& csv);

}  // namespace tendril::app
