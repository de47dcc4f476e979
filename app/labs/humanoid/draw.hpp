// What the picture makes of a skeleton: which nodes are the body, which only help, and how thick bones are.
#pragma once

#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

/// A node's number is its pick.
constexpr PickId node_pick(std::size_t node) {
    return static_cast<PickId>(node);
}
/// Of an effector's ball.
constexpr PickId first_effector_pick = 1'000'000;
constexpr PickId effector_pick(humanoid::Effector effector) {
    return first_effector_pick + static_cast<PickId>(effector);
}
/// Of what the head looks at.
inline constexpr PickId look_pick = first_effector_pick + 100;
std::optional<humanoid::Effector> picked_effector(PickId pick);
std::optional<std::size_t> picked_node(const HumanoidPart& part, PickId pick);

/// Of each node, whether it is part of the body: mapped, between mapped ones, or the end of a mapped one.
/// Fingers, twist bones and what carries the whole are not. All are, where hardly anything is mapped.
std::vector<bool> body_nodes(const HumanoidPart& part);
/// Of each node, whether a spring turns it.
std::vector<bool> swinging_nodes(const HumanoidPart& part, Solvers& solvers);

/// Nodes of the body that end in nothing, and how far the picture lets them go on, in their own space.
glm::dvec3 end_of(const HumanoidPart& part, std::size_t node);

}  // namespace tendril::app
