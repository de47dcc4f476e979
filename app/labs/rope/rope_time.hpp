// Advances time in the Rope lab, in its world and in a race's rivals: whole ticks, or uneven frames with
// frame-time jitter; and swinging colliders.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/document/runtime.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/view/palette.hpp"
#include "app/view/panes.hpp"

namespace tendril::app {

/// The workspace for simulating and dragging, kept between ticks.
struct RopeRuntime final : Runtime {
    RopeRuntime();
    rope::Workspace workspace;  ///< multi-threaded if the machine has several cores
    /// The same for each rival of a race, so that each keeps its own preparation.
    std::array<rope::Workspace, 2> of_rivals;
};

/// Advances the lab by `seconds`. The result does not depend on how the time is divided into calls, unless
/// substeps are dropped because of max_lab_work. Any `workspace` works; keeping one is fastest.
RopeReport pass_time(RopePart& part, double seconds, rope::Workspace& workspace);
/// The work of a substep, for max_lab_work. Not timed, so every machine drops the same substeps.
std::uint64_t work_of_substep(const NamedWorld& world);

/// Length in seconds of the frame with that number: even at dial 0, from 1 to 250 ms at dial 1.
double jitter_frame(const Jitter& jitter, std::uint32_t number);

/// Centre of a swinging collider at a simulated time.
glm::vec3 swing_point(const Swing& swing, double time);
/// Throws std::invalid_argument if the swing leaves the range of coordinates.
void require(const Swing& swing);

/// True if no pin or collider is moving, and no particle moves visibly.
bool at_rest(const RopePart& part);

/// True if everything is within the bounds of the world.
bool in_range(const NamedWorld& world);

// A race: the scene with each solver, side by side with one camera. A command that changes the part's own
// world also changes its rivals' worlds, and all pass the same ticks.

class CommandTable;

/// In the order of the panes: the part itself, then its rivals.
std::vector<std::reference_wrapper<const RopeRacer>> rope_racers(const RopePart& part);
RopeSample last_sample(const RopeRacer& racer);
/// The racer drawn in a pane; the part itself if there is no such pane.
const RopeRacer& racer_in(const RopePart& part, std::size_t pane);
inline const NamedWorld& world_in(const RopePart& part, std::size_t pane) {
    return *racer_in(part, pane).world;
}

/// Starts the race from the present state of the part's own world.
void begin_race(RopePart& part);
/// The part with the rival's world, samples and drag in place of its own.
RopePart part_of_rival(const RopePart& part, const RopeRacer& rival);
/// Applies to each rival the command that changed `part`'s own world, which was `old` before. A rival without
/// the named object, such as a tie that tore there, does not change. If the command chose a rival's solver,
/// the two swap places.
void change_rivals(RopePart& part, const RopePart& old, const std::function<void(RopePart&)>& change);
/// Sets the settings of all worlds; each rival keeps its solver, or swaps places as above.
void take_settings(RopePart& part, const rope::Settings& settings);

glm::vec3 rope_solver_colour(const Palette& palette, rope::Solver solver);
/// "length error 0.02 %, 12.30 J"
std::string racer_text(const RopeSample& last);
/// Titles of the panes; none without a race. `cost`: including the time per tick.
std::vector<PaneTitle> rope_panes(const RopePart& part, const Palette& palette, bool cost);

void add_rope_race_commands(CommandTable& table);

}  // namespace tendril::app
