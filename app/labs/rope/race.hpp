// A race: the scene by each solver, side by side with one camera. What a command does to the part's own world
// it does to those of its rivals too, and they pass the same ticks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/labs/rope/rope_part.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/palette.hpp"
#include "app/view/panes.hpp"

namespace tendril::app {

class CommandTable;

/// One of the worlds of a part, in the order of its panes: its own, then those of its rivals.
struct RopeRacer {
    const NamedWorld& world;
    const std::vector<RopeSample>& samples;

    rope::Solver solver() const { return world.settings().solver; }
    RopeSample last() const;
};
std::vector<RopeRacer> rope_racers(const RopePart& part);
/// The world that is drawn in a pane; the part's own if there is no such pane.
const NamedWorld& world_in(const RopePart& part, std::size_t pane);

/// Starts the race from where the part's own world is now.
void begin_race(RopePart& part);
/// The part as it is for a rival.
RopePart part_of_rival(const RopePart& part, const Rival& rival);
/// Does to each rival what a command did to `part`'s own world, which was `old` before. A rival that
/// lacks what it names, as a tie that tore there, stays as it is. If the command chose a rival's solver, the
/// two change places.
void change_rivals(RopePart& part, const RopePart& old, const std::function<void(RopePart&)>& change);
/// Sets the settings of all worlds; each rival keeps its solver, or changes places as above.
void take_settings(RopePart& part, const rope::Settings& settings);

glm::vec3 rope_solver_colour(const Palette& palette, rope::Solver solver);
/// "length error 0.02 %, 12.30 J"
std::string racer_text(const RopeSample& last);
/// Titles of the panes; none without a race. `cost`: with the time per tick.
std::vector<PaneTitle> rope_panes(const RopePart& part, const Palette& palette, bool cost);

/// One row for each tick and solver of the last ten seconds.
std::string rope_race_csv(const Workspace& workspace);

void add_rope_race_commands(CommandTable& table);

}  // namespace tendril::app
