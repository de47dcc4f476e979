// Commands that write the open race to a file: its numbers, or a video.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "app/document/units.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/kit/film.hpp"
#include "app/labs/kit/race.hpp"

namespace tendril::app {
namespace {

std::string open_race_csv(const Workspace& workspace) {
    const ShownChain shown = shown_chain(workspace);
    check_race(shown.part);
    return race_csv(*shown.race);
}

constexpr double frames_per_second = 30.0;
constexpr int end_frames = 30;  ///< the end is held for a second, so that a film takes 4 to 12 s
constexpr double max_frames = 18'000.0;

/// Shows a frame of the film in a copy of the workspace.
struct RaceFrames {
    std::size_t last = 0;  ///< iteration
    double pace = 4.0;     ///< iterations per second
    std::size_t shown = Study::race_end;

    bool operator()(Workspace& workspace, int frame) {
        const double iteration = std::floor(frame * pace / frames_per_second);
        const std::size_t now = std::min(last, static_cast<std::size_t>(iteration));
        workspace.document.edit<ChainPart>(chain_lab).study.go_to(now, last);
        return std::exchange(shown, now) != now;
    }
};

void record_race(Workspace& workspace, const Arguments& given) {
    const ShownChain chain = shown_chain(workspace);
    check_race(chain.part);
    if (workspace.lab != chain_lab) throw Refused("the race is not in view: open the lab chain");
    const std::size_t last = chain.last();
    const double pace = given.has("pace") ? given.real("pace") : static_cast<double>(race_pace(last));
    const double frames = std::ceil(static_cast<double>(last) * frames_per_second / pace) + 1.0 + end_frames;
    if (frames > max_frames)
        throw Refused("pace must be at least " +
                      fixed_text(0.01 * std::ceil(100.0 * static_cast<double>(last) * frames_per_second /
                                                  (max_frames - 1.0 - end_frames)),
                                 2) +
                      " for a race of " + std::to_string(last) +
                      " iterations: a film lasts up to 10 minutes");
    VideoRequest wanted = film_request(workspace, given, "race");
    wanted.command = "race.record";
    wanted.shown_frames = static_cast<int>(frames);
    wanted.show = RaceFrames{last, pace};
    workspace.ui.video = std::move(wanted);
}

}  // namespace

void add_race_file_commands(CommandTable& table) {
    add_race_csv_commands(table, {.race = "race",
                                  .title = "the race as CSV",
                                  .holds = "tip to target in metres, for every solver and iteration,",
                                  .text = open_race_csv});
    table.add(
        "race.record", "Record the race",
        film_arguments(
            {number_argument("pace", "iterations per second; default: so many that the film lasts 4 to 12 s",
                             shortest_decimal(slowest_pace), shortest_decimal(fastest_pace))},
            true),
        "Writes a video of the race from its start to its end, with names, iterations and errors",
        Effect::Look, record_race);
}

}  // namespace tendril::app
