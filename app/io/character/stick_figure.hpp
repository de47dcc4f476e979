// The built-in figure: 1.8 m tall, in T-pose, facing +Z, with a body (figure_body.hpp), and a computed walk
// and punch.
#pragma once

#include "app/io/character/character.hpp"

namespace tendril::app {

/// Nodes have the names of bone_map.hpp and no rotation at rest. The clips are "walk", which moves 1.1 m
/// towards +Z in 1.1 s and loops, and "punch", a hook of the right hand that begins and ends in the guard
/// position. Made at the first call, which takes a tenth of a second.
const Character& stick_figure();

/// Where the sole touches the ground at rest, relative to the ankle; metres.
inline constexpr glm::dvec3 stick_heel{0.0, -0.09, -0.05}, stick_toe{0.0, -0.09, 0.15};

}  // namespace tendril::app
