// Drawing of the Humanoid lab: nodes by their kind, pick ids, attachments, joint limits, the past.
#pragma once

#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/lab.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

/// A node's pick id is its index.
constexpr PickId node_pick(std::size_t node) {
    return static_cast<PickId>(node);
}
/// The pick id of an effector's ball.
constexpr PickId first_effector_pick = 1'000'000;
constexpr PickId effector_pick(humanoid::Effector effector) {
    return first_effector_pick + static_cast<PickId>(effector);
}
/// The pick id of the look-at target.
inline constexpr PickId look_pick = first_effector_pick + 100;
std::optional<humanoid::Effector> picked_effector(PickId pick);
std::optional<std::size_t> picked_node(const HumanoidPart& part, PickId pick);

/// For each node, whether it belongs to the body: mapped, between mapped nodes, the only child of a mapped
/// one, or along a curve. Excludes fingers, twist bones and nodes above the hips. If few are mapped: all.
std::vector<bool> body_nodes(const HumanoidPart& part);
/// For each node, whether a spring turns it.
std::vector<bool> swinging_nodes(const HumanoidPart& part, Solvers& solvers);

/// Where to draw the end of a bone without children, in the node's space.
glm::dvec3 end_of(const HumanoidPart& part, std::size_t node);

/// Colour of the centre of mass: a warning outside the feet, unless a foot is stepping to catch it.
glm::vec3 balance_colour(const HumanoidPart& part, const ShownPose& shown, const Palette& colours);

/// A sphere around the figure as shown, its skin included.
Bounds figure_bounds(const Workspace& workspace);

// Attachments, joint limits and the past.

/// The colour of attached ropes and cloth.
glm::vec3 attached_colour(const Palette& palette);
void draw_attachments(const View& view, DrawList& list, const Attachments& attachments);

glm::vec3 adult_colour(const Palette& palette);
glm::vec3 clips_colour(const Palette& palette);

/// Depends on the view's setting. The active joint is drawn in full, other selected joints as outlines with
/// their current rotation, all other joints as outlines. Joints stopped by limits show only those limits.
void draw_limits(const View& view, DrawList& list, const HumanoidPart& part, const ShownPose& shown);
/// Legend of the limit colours; empty if none are drawn.
std::vector<LegendRow> limits_legend(const Workspace& workspace);

/// Frees the cached poses once nothing of the past is shown.
void forget_past_poses(const Workspace& workspace);
/// Draws the body before the displayed incident over the current one.
void draw_humanoid_incident(const View& view, const ShownPose& shown, DrawList& list);

}  // namespace tendril::app
