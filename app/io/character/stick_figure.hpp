// The figure that is there without any file: 1.8 m, in T-pose, facing +Z, with a walk and a punch made by
// calculation.
#pragma once

#include "app/io/character/character.hpp"

namespace tendril::app {

/// Nodes are named as bone_map.hpp names bones, and rest without a rotation. Its clips are "walk", which
/// goes 1.1 m towards +Z in 1.1 s and loops, and "punch", a hook of the right hand that begins and ends in
/// its guard.
Character stick_figure();

/// Where the sole touches the ground, from the ankle, as the figure rests; metres.
inline constexpr glm::dvec3 stick_heel{0.0, -0.09, -0.05}, stick_toe{0.0, -0.09, 0.15};

}  // namespace tendril::app
