// The Linkage lab's last ten seconds: plots, past poses and incidents.
#pragma once

#include "app/labs/kit/past_view.hpp"
#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {

PastView linkage_past();
/// Empty while nothing is plotted.
std::optional<PastCurve> linkage_past_curve(const Workspace& workspace);
PoseLines linkage_lines(const SharedPart& part);

/// Dead points, ranges, points that jumped, and bars that do not meet, between two ticks.
std::vector<Incident> linkage_incidents(const LinkagePart& before, const LinkagePart& after);
/// The target whose point jumped in the last solve; the mouse's while it drags. Null: none did.
const LinkageTarget* jumped_target(const LinkagePart& part);
/// The three joints of two bars that are most nearly in line, the middle one between; empty: none are within
/// so many degrees.
std::vector<std::size_t> joints_in_line(const LinkagePart& part, double within = 4.0);
/// "B, C and D are in line": why a motor stops there. Empty if no joint shows it.
std::string dead_point_reason(const LinkagePart& part, double within = 4.0);

}  // namespace tendril::app
