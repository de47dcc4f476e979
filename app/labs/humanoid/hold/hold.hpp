// The object that the hands hold: solving, reporting, drawing, commands. Its settings: hold_setting.hpp.
#pragma once

#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/panel.hpp"

namespace tendril::app {

/// The pick id of the object.
inline constexpr PickId hold_pick = first_effector_pick + 101;

/// True if the hand holds the object; it then has no target of its own.
inline bool holds(const HumanoidPart& part, humanoid::Effector effector) {
    return part.ik.hold && part.ik.hold->holds(effector);
}

/// Solves the body with its hands on the object, which must be held.
Expected<humanoid::HoldReport> solve_hold(const HumanoidPart& part, humanoid::Body& body, ShownPose& shown,
                                          std::span<const humanoid::BodyTarget> targets,
                                          const humanoid::BodyOptions& options, IkState& state);

/// The handle is at the object's requested pose.
Handle hold_handle(const HoldSetting& setting, const ShownPose& shown);
void drag_hold(const HoldSetting& setting, const ShownPose& shown, const Handle::Frame& to, Emit& emit);

/// Whether the object is off its requested pose, and whether a hand is on its grip, within the reported
/// amounts: half a millimetre, half a degree. HoldReport::closed() is stricter.
bool gives_way(const humanoid::HoldReport& report);

/// "The wheel gives way by 12 cm", and why: "The left arm is straight."
Verdict hold_verdict(const HoldSetting& setting, const humanoid::HoldReport& report);
/// Null if nothing is held.
Json hold_state(const HumanoidPart& part, const ShownPose& shown);

void draw_hold(const View& view, DrawList& list, const HumanoidPart& part, const ShownPose& shown);
/// Rows of the section Hands and gaze.
void hold_rows(const HumanoidPanel& panel);

void add_hold_commands(CommandTable& table);

}  // namespace tendril::app
