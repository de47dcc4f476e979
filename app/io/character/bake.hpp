// A clip with what is solved on top of it frame by frame, as a clip again.
#pragma once

#include <functional>
#include <span>
#include <tendril/humanoid/feet.hpp>

#include "app/io/character/character.hpp"

namespace tendril::app {

/// What the IK makes of a frame's pose, local transforms of all nodes, in place. Called once a frame, in
/// their order; `dt` is the time since the frame before, 0 at the first.
using PoseStep = std::function<void(std::span<rig::Transform> pose, double time, double dt)>;

/// The clip at `rate` frames a second and at its end, each frame as `step` leaves it. Nodes that it never
/// changes keep the keys that they have. Throws std::runtime_error over 50 million keys.
humanoid::Clip baked(const humanoid::Skeleton& skeleton, const humanoid::Clip& clip, double rate,
                     const PoseStep& step);

/// With its feet on the ground. Throws std::runtime_error where the map has no two legs.
humanoid::Clip with_feet_on(const humanoid::Ground& ground, const humanoid::Skeleton& skeleton,
                            const humanoid::BoneMap& map, const humanoid::Clip& clip, double rate);

}  // namespace tendril::app
