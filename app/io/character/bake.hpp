// Bakes a solver's frame-by-frame changes of a clip into a new clip.
#pragma once

#include <functional>
#include <span>
#include <tendril/humanoid/feet.hpp>

#include "app/io/character/character.hpp"

namespace tendril::app {

/// Changes a frame's pose, the local transforms of all nodes, in place. Called once per frame, in order; `dt`
/// is the time in seconds since the previous frame, 0 at the first.
using PoseStep = std::function<void(std::span<rig::Transform> pose, double time, double dt)>;

/// The clip sampled at `rate` frames per second and at its end, after `step`. Nodes that `step` never changes
/// keep their keys. Throws std::runtime_error above 50 million keys.
humanoid::Clip baked(const humanoid::Skeleton& skeleton, const humanoid::Clip& clip, double rate,
                     const PoseStep& step);

/// The clip with its roots moving at an additional velocity, m/s.
humanoid::Clip travelling(const humanoid::Skeleton& skeleton, const humanoid::Clip& clip,
                          const glm::dvec3& velocity, double rate);

/// The clip with its feet on the ground. Throws std::runtime_error if the map lacks two legs.
humanoid::Clip with_feet_on(const humanoid::Ground& ground, const humanoid::Skeleton& skeleton,
                            const humanoid::BoneMap& map, const humanoid::Clip& clip, double rate);

}  // namespace tendril::app
