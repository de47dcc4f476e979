// What a lab shows of its last ten seconds beside the strip: a plot of one number over them, with a mark for
// each incident, and the poses of them, faint, one for each half second.
//
// A lab says which numbers it has (PastView), what the chosen one is in its part as it was at a moment
// (PastCurve), and which lines show the pose there. All else is here. What is chosen is a setting of the
// person's; what is worked out of a moment is kept as long as that is remembered, and nothing is worked out
// while nothing is shown.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/labs/kit/past_strip.hpp"
#include "app/labs/kit/setting.hpp"
#include "app/labs/lab.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// Of a moment of the past, or of the present.
using SharedPart = std::shared_ptr<const Part>;

struct PastView {
    std::string lab;
    /// Whether two parts have the same joints: the poses of one are none of the other's.
    std::function<bool(const Part&, const Part&)> same_joints;
    LabSetting plot;    ///< nothing, or one of the lab's numbers
    LabSetting ghosts;  ///< nothing, or the past

    bool plots(const Settings& settings) const { return plot.chosen(settings) > 0; }
    bool shows_ghosts(const Settings& settings) const { return ghosts.chosen(settings) > 0; }
    /// Of the numbers, where it plots.
    std::size_t chosen(const Settings& settings) const { return plot.chosen(settings) - 1; }
};
/// `what` the lab shows, as commands have it: "chain". `numbers`: at least one. Without `same_joints` all
/// parts have the same.
PastView past_view(const std::string& lab, const std::string& what, std::vector<LabSetting::Choice> numbers,
                   std::function<bool(const Part&, const Part&)> same_joints = {});

/// The number that is plotted.
struct PastCurve {
    std::string name;                                ///< of which joint it is, too: "swing of joint 2"
    std::string of;                                  ///< what tells it from all others
    std::string unit = "deg";                        ///< or "m", "N", ...
    float lowest_range = 10.0f;                      ///< of the axis, in that unit
    std::string missing;                             ///< how to get one, where it is known at no moment
    std::function<double(const SharedPart&)> value;  ///< NaN where it is not known
    /// Whether the value of a moment costs next to nothing. Null: at every moment.
    std::function<bool(const SharedPart&)> at_hand{};
};

/// What a lab's tooltips say.
struct PastHelp {
    const char* plot;
    const char* ghosts;
};
/// The panel: what is plotted, and whether there are ghosts.
void past_view_rows(const Workspace& workspace, const PastView& view, const PastHelp& help, Emit& emit);

/// Pixels at scale 1, below the strip; 0 where nothing is plotted.
float past_plot_height(const Settings& settings, const PastView& view);
/// Nothing, where no curve is given. In a live window not all is there at once: a frame works out a few
/// moments that are not at hand, the last ones first. `strip`: of the last ten seconds, where that is above
/// it: a moment is at the same place in both. A click or a drag goes to a moment, as on the strip.
void past_plot(const Workspace& workspace, const PastView& view, const std::optional<PastCurve>& curve,
               const std::optional<StripLine>& strip, Emit& emit);
/// Whether the next frame has more of it.
bool past_plot_waits(const Workspace& workspace, const PastView& view);

/// A value at each moment where it is known, by tick; the last one may be the present.
struct PastValue {
    std::uint64_t tick = 0;
    float value = 0.0f;
};
inline constexpr std::size_t all_moments = std::numeric_limits<std::size_t>::max();
/// Works out `most_made` of those at most that are not at hand; what is left, is left out.
std::vector<PastValue> past_values(const Workspace& workspace, const PastView& view, const PastCurve& curve,
                                   std::size_t most_made = all_moments);

/// A pose as lines from point to point.
using PoseLines = std::vector<std::pair<glm::vec3, glm::vec3>>;
/// The moments that are shown as ghosts, by tick: of what has the joints that there are now.
std::vector<const Rewind::Moment*> ghost_moments(const Workspace& workspace, const PastView& view);
/// A pose of more lines than this is not drawn: twenty of them would drown the picture.
inline constexpr std::size_t max_ghost_lines = 1000;
inline constexpr const char* ghost_legend = "past poses";
void draw_past_ghosts(const View& view, const PastView& past,
                      const std::function<PoseLines(const SharedPart&)>& pose, DrawList& list);

/// For --state: {"plot": null or what is plotted, with its values, "ghosts": their ticks}.
Json past_view_state(const Workspace& workspace, const PastView& view, const std::optional<PastCurve>& curve);

// Marks in the picture of what an incident did: how far something turned, and where.

/// The way that the end of a bone went which turned about its start, on the shorter way round.
void draw_turn(const View& view, glm::vec3 from, glm::vec3 to, glm::vec3 about, DrawList& list);

/// A ring around what it happened to and, for a flip, how far it turned.
void draw_incident_mark(const View& view, const Incident& incident, glm::vec3 at, DrawList& list);

// The section of an inspector that lists what happened in the last ten seconds.

/// The last flips and what else happened; a click goes to it. Nothing where there are none.
void incident_rows(const Workspace& workspace, const Palette& palette, Emit& emit);

}  // namespace tendril::app
