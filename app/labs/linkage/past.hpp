// The Linkage lab's last ten seconds: plots, past poses and incidents.
#pragma once

#include "app/labs/kit/past.hpp"
#include "app/labs/linkage/linkage_part.hpp"
#include "app/widgets/plot.hpp"

namespace tendril::app {

inline constexpr const char* transmission_name = "transmission angle";
/// The plotted number over the value of the joint that leads the turn, as it is shown: two pieces if it
/// passes 360 degrees. None if there is no turn, or the number is that joint's own.
std::vector<Curve> linkage_turn_curves(const Workspace& workspace, const PastCurve& curve);
/// The target whose point jumped in the last solve; the mouse's while it drags. Null: none did.
const LinkageTarget* jumped_target(const LinkagePart& part);

}  // namespace tendril::app
