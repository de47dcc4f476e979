// A lab's view of its last ten seconds: a plot of one number below the scene, with a mark for each incident,
// and faint past poses, one for each half second.
//
// A lab declares which numbers it has (PastView), how to compute the chosen one from its part at a moment
// (PastCurve), and which lines show the pose. The user's choices are settings. Values are computed only while
// they are shown, and cached while the rewind holds their moment.
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

/// A lab's part at a past moment, or now.
using SharedPart = std::shared_ptr<const Part>;

struct PastView {
    std::string lab;
    /// Whether two parts have the same joints; if not, the poses of one cannot be shown with the other.
    std::function<bool(const Part&, const Part&)> same_joints;
    LabSetting plot;    ///< "nothing", or one of the lab's numbers
    LabSetting ghosts;  ///< "nothing", or "past"

    bool plots(const Settings& settings) const { return plot.chosen(settings) > 0; }
    bool shows_ghosts(const Settings& settings) const { return ghosts.chosen(settings) > 0; }
    /// The index of the plotted number. Needs plots().
    std::size_t chosen(const Settings& settings) const { return plot.chosen(settings) - 1; }
};
/// `what`: the lab's subject in command titles: "chain". `numbers`: at least one. Without `same_joints`, all
/// parts count as having the same joints.
PastView past_view(const std::string& lab, const std::string& what, std::vector<LabSetting::Choice> numbers,
                   std::function<bool(const Part&, const Part&)> same_joints = {});

/// The plotted number.
struct PastCurve {
    std::string name;                                ///< with the joint: "swing of joint 2"
    std::string of;                                  ///< a unique key; a new key drops the cached values
    std::string unit = "deg";                        ///< or "m", "N", ...
    float lowest_range = 10.0f;                      ///< minimum upper end of the axis, in `unit`
    std::string missing;                             ///< shown if no moment has a value: how to get one
    std::function<double(const SharedPart&)> value;  ///< NaN if unknown
    /// Whether a moment's value is cheap to compute. Null: always.
    std::function<bool(const SharedPart&)> at_hand{};
};

/// The lab's tooltips.
struct PastHelp {
    const char* plot;
    const char* ghosts;
};
/// The panel rows that choose the plot and switch the past poses.
void past_view_rows(const Workspace& workspace, const PastView& view, const PastHelp& help, Emit& emit);

/// Pixels at scale 1, below the strip; 0 if nothing is plotted.
float past_plot_height(const Settings& settings, const PastView& view);
/// Draws nothing without a curve. A live window fills the plot over several frames: each computes a few
/// moments that are not cheap, newest first. `strip`: the strip above, if any; both then share their time
/// axis. A click or drag seeks, as on the strip.
void past_plot(const Workspace& workspace, const PastView& view, const std::optional<PastCurve>& curve,
               const std::optional<StripLine>& strip, Emit& emit);
/// Whether moments are still to be computed.
bool past_plot_waits(const Workspace& workspace, const PastView& view);

/// The value at a tick. The last one may be the present.
struct PastValue {
    std::uint64_t tick = 0;
    float value = 0.0f;
};
inline constexpr std::size_t all_moments = std::numeric_limits<std::size_t>::max();
/// The known values, by tick. Computes at most `most_made` that are not cheap and omits the rest.
std::vector<PastValue> past_values(const Workspace& workspace, const PastView& view, const PastCurve& curve,
                                   std::size_t most_made = all_moments);

/// A pose as line segments.
using PoseLines = std::vector<std::pair<glm::vec3, glm::vec3>>;
/// The moments shown as past poses, by tick: those with the same joints as now.
std::vector<const Rewind::Moment*> ghost_moments(const Workspace& workspace, const PastView& view);
/// Poses with more lines are not drawn: twenty of them would clutter the picture.
inline constexpr std::size_t max_ghost_lines = 1000;
inline constexpr const char* ghost_legend = "past poses";
void draw_past_ghosts(const View& view, const PastView& past,
                      const std::function<PoseLines(const SharedPart&)>& pose, DrawList& list);

/// For --state: {"plot": null or the plot with its values, "ghosts": ticks}.
Json past_view_state(const Workspace& workspace, const PastView& view, const std::optional<PastCurve>& curve);

// Marks of an incident in the scene.

/// The arc of a bone's end from `from` to `to`, the shorter way round `about`.
void draw_turn(const View& view, glm::vec3 from, glm::vec3 to, glm::vec3 about, DrawList& list);

/// A ring around the joint and, for a flip, the angle.
void draw_incident_mark(const View& view, const Incident& incident, glm::vec3 at, DrawList& list);

// The inspector section that lists the incidents of the last ten seconds.

/// The latest incidents; a click goes to one. Nothing if there are none.
void incident_rows(const Workspace& workspace, const Palette& palette, Emit& emit);

}  // namespace tendril::app
