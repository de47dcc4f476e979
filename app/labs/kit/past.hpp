// A lab's last ten seconds. Below the scene, a strip has a mark for each incident and a plot of one number;
// the scene shows faint past poses, one for each half second; the inspector lists the incidents.
//
// A lab declares its table, Lab::past(): the numbers that can be plotted, which lines show its pose, and what
// happened between two ticks. Settings and their commands, strip, plot and --state follow from it. Values are
// computed only while they are shown, and cached while the rewind holds their moment.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/labs/kit/setting.hpp"
#include "app/labs/lab.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"
#include "app/widgets/timeline.hpp"

namespace tendril::app {

/// A lab's part at a past moment, or now.
using SharedPart = std::shared_ptr<const Part>;
template <class LabPart>
const LabPart& part_as(const Part& part) {
    return dynamic_cast<const LabPart&>(part);
}
template <class LabPart>
const LabPart& part_as(const SharedPart& part) {
    return part_as<LabPart>(*part);
}

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// A number over time.
struct PastCurve {
    std::string name;                                  ///< the plotted number: "swing of joint 2"
    std::string unit = "deg";                          ///< or "m", "N", ...
    float lowest_range = 10.0f;                        ///< minimum upper end of the axis, in `unit`
    std::string missing{};                             ///< shown if no moment has a value: how to get one
    std::function<double(const SharedPart&)> value{};  ///< in `unit`; no_value if unknown
    /// Whether a moment's value is cheap to compute. Null: always cheap.
    std::function<bool(const SharedPart&)> at_hand{};
    std::string of{};  ///< when this key changes, cached values are dropped; empty: the name
};

/// A number that a lab can plot.
struct Probe {
    const char *name, *title;              ///< in commands and in menus: "swing", "swing of a joint"
    PastCurve (*curve)(const Workspace&);  ///< for the present selection
};

/// A pose as line segments.
using PoseLines = std::vector<std::pair<glm::vec3, glm::vec3>>;

struct Past {
    std::string lab;
    const char* what;  ///< the lab's subject in command titles: "chain"
    std::vector<Probe> probes;
    const char *plot_help, *ghosts_help;
    PoseLines (*pose)(const Workspace&, const SharedPart&);
    /// True if two parts have the same joints; if not, poses of one cannot be shown with the other, and its
    /// incidents are dropped.
    bool (*same_joints)(const Part& then, const Part& now) = nullptr;
    /// Events in a change or a tick that the user may ask about, such as a joint that jumped.
    std::vector<Incident> (*incidents)(const Workspace&, const Part& before, const Part& after) = nullptr;

    LabSetting plot() const;    ///< "nothing", or a probe
    LabSetting ghosts() const;  ///< "nothing", or "past"
    bool shows_ghosts(const Settings& settings) const { return ghosts().chosen(settings) > 0; }
    /// The curve of the chosen probe, if one is plotted.
    std::optional<PastCurve> curve(const Workspace& workspace) const;
};

// Below the scene.

/// The moments that the rewind holds, and the present.
struct PastTicks {
    std::uint64_t first = 0, last = 0;

    /// The index of a tick, counted from `first`.
    int place(std::uint64_t tick) const { return static_cast<int>(std::clamp(tick, first, last) - first); }
};
/// The strip always has this length, even if less is recorded.
inline constexpr int past_strip_ticks = static_cast<int>(Rewind::max_ticks) + 1;
/// At an earlier moment: "An edit here discards the 2.3 s after it. Undo brings them back."; else empty.
std::string discards_text(const Workspace& workspace);

/// The extent of the strip's line, in pixels of the window.
struct StripLine {
    float left = 0.0f, right = 0.0f;
};
/// Includes the buttons to its left.
StripLine past_strip(const Workspace& workspace, Emit& emit);

// The parts of past_strip(), for a lab that shows another strip beside it.

/// Records the last ten seconds as a video of the scene view. A small button below the replay button, so that
/// the strip keeps its length.
void record_button(const Workspace& workspace, Emit& emit);
/// Replays the last ten seconds, or stops the replay.
void replay_button(const Workspace& workspace, Emit& emit);
/// Switches between this strip (while `shown`) and the lab's other one, called `other` ("clip"). True in the
/// frame of the click.
bool other_strip_button(bool shown, const std::string& other);
/// The strip without buttons.
StripLine past_time_strip(const Workspace& workspace, Emit& emit);
/// The mark of an incident at tick `at` of another strip.
TimeMark incident_mark(const Incident& incident, int at, const Palette& palette);
/// Shows the tooltip while the mouse is on that mark.
void tell_incident(const Incident& incident);

/// Pixels at scale 1, below the strip; 0 if nothing is plotted.
float past_plot_height(const Settings& settings, const Past& past);
/// A live window fills the plot over several frames: each frame computes a few expensive moments, newest
/// first. `strip`: the strip above, if any; both then share their time axis. A click or drag seeks, as on the
/// strip.
void past_plot(const Workspace& workspace, const Past& past, const std::optional<StripLine>& strip,
               Emit& emit);
/// True if some moments are not computed yet.
bool past_plot_waits(const Workspace& workspace, const Past& past);

/// The value at a tick. The last one may be the present.
struct PastValue {
    std::uint64_t tick = 0;
    float value = 0.0f;
};
inline constexpr std::size_t all_moments = std::numeric_limits<std::size_t>::max();
/// The known values of the curve, by tick. Computes at most `most_made` expensive ones and omits the rest.
std::vector<PastValue> past_values(const Workspace& workspace, const Past& past, const PastCurve& curve,
                                   std::size_t most_made = all_moments);

// Panels and --state.

/// The panel rows that choose the plot and switch the past poses.
void past_rows(const Workspace& workspace, const Past& past, Emit& emit);
/// The inspector's latest incidents; a click goes to one. Draws nothing if there are none.
void incident_rows(const Workspace& workspace, const Palette& palette, Emit& emit);
/// {"plot": null or the plot with its values, "ghosts": ticks}.
Json past_state(const Workspace& workspace, const Past& past);

// In the scene.

/// The moments shown as past poses, by tick: those with the same joints as now.
std::vector<const Rewind::Moment*> ghost_moments(const Workspace& workspace, const Past& past);
/// Poses with more lines are not drawn: twenty of them would clutter the picture.
inline constexpr std::size_t max_ghost_lines = 1000;
void draw_past_ghosts(const View& view, const Past& past, DrawList& list);
/// Adds the past poses to the legend while they are shown.
void add_ghost_legend(const Workspace& workspace, const Past& past, std::vector<LegendRow>& rows);

/// The arc of a bone's end from `from` to `to` about `about`, the shorter way.
void draw_turn(const View& view, glm::vec3 from, glm::vec3 to, glm::vec3 about, DrawList& list);
/// A ring around the joint and, for a flip, the angle.
void draw_incident_mark(const View& view, const Incident& incident, glm::vec3 at, DrawList& list);

}  // namespace tendril::app
