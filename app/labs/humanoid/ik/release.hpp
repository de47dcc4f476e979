// What comes after a target is let go: the limb eases back to the clip, and the rest of the body gives up
// what only that target has asked of it.
//
// The pose that follows is worked out at once. While a clip plays, what the pose was beyond it is kept and
// fades out (inertialization: D. Bollo, "Inertialization: High-Performance Animation Transitions in Gears of
// War", GDC 2018), so that no joint leaps, whatever it was that changed. Where no clip plays the limb is back
// at once.
#pragma once

#include <optional>
#include <vector>

#include "app/labs/humanoid/ik/ik_settings.hpp"

namespace tendril::app {

inline constexpr double release_seconds = 1.0;  ///< until all is settled
inline constexpr double fade_seconds = 0.2;     ///< of that, at its beginning: until the limb is back
/// Of a target, in m/s, with which the rest of the body comes nearer to the clip.
inline constexpr double settle_speed = 1.2;

/// What fades out: rotations and the hips' way from `now` to `before`, two poses of one character.
Release release_between(const std::vector<rig::Transform>& before, const std::vector<rig::Transform>& now,
                        std::optional<std::size_t> hips);
/// 1 just after the target was let go, 0 once it has faded out.
double fading(const Release& release);
void apply(const Release& release, std::vector<rig::Transform>& pose, std::optional<std::size_t> hips);
/// Some seconds later; empty when it is over.
void pass(Release& release, double seconds);
/// For a target that is new: what it reaches for is reached at once.
void forget_on_the_way_to(Release& release, const humanoid::Skeleton& skeleton, std::size_t node);

}  // namespace tendril::app
