// Classifies nodes for drawing: body, helpers, springs; and pick ids.
#pragma once

#include "app/labs/humanoid/ik/shown_pose.hpp"
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
/// one, or along a curve. Excludes fingers, twist bones and nodes above the hips. If hardly any node is
/// mapped, all belong.
std::vector<bool> body_nodes(const HumanoidPart& part);
/// For each node, whether a spring turns it.
std::vector<bool> swinging_nodes(const HumanoidPart& part, Solvers& solvers);

/// Where a bone without a child is drawn to end, in the node's space.
glm::dvec3 end_of(const HumanoidPart& part, std::size_t node);

/// Of the centre of mass: a warning where it is outside the feet, unless a foot is stepping to catch it.
glm::vec3 balance_colour(const HumanoidPart& part, const ShownPose& shown, const Palette& colours);

}  // namespace tendril::app
