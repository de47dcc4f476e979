// The Linkage lab's last ten seconds: plots, past poses and incidents.
#pragma once

#include "app/labs/kit/past_view.hpp"
#include "app/labs/linkage/linkage_part.hpp"
#include "app/widgets/plot.hpp"

namespace tendril::app {

PastView linkage_past();
/// Empty if nothing is plotted.
std::optional<PastCurve> linkage_past_curve(const Workspace& workspace);
inline constexpr const char* transmission_name = "transmission angle";
/// The plotted number over the displayed value of the joint that leads the turn, in two pieces if it passes
/// 360 degrees. Empty if there is no turn, or the number is that joint's own value.
std::vector<Curve> linkage_turn_curves(const Workspace& workspace, const PastCurve& curve);
PoseLines linkage_lines(const SharedPart& part);

/// Incidents between two ticks: dead points, range ends, jumping points, and bars that do not meet.
std::vector<Incident> linkage_incidents(const LinkagePart& before, const LinkagePart& after,
                                        LinkageRuntime& runtime);
/// The target whose point jumped in the last solve; during a drag the mouse's. Null if none did.
const LinkageTarget* jumped_target(const LinkagePart& part);
}  // namespace tendril::app
