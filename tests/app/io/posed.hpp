// Positions of a character's nodes, at rest and in a clip.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <tendril/humanoid/clip.hpp>
#include <vector>

#include "app/io/character/character.hpp"

namespace tendril::app::test_posed {

inline std::vector<humanoid::Placement> placed_as(const humanoid::Skeleton& skeleton,
                                                  std::span<const rig::Transform> pose) {
    std::vector<humanoid::Placement> placements(skeleton.size());
    place(skeleton, pose, placements);
    return placements;
}
inline std::vector<humanoid::Placement> placed_in(const humanoid::Skeleton& skeleton,
                                                  const humanoid::Clip& clip, double time) {
    std::vector<rig::Transform> pose(skeleton.size());
    sample(clip, skeleton, time, pose);
    return placed_as(skeleton, pose);
}
/// In the clip of that index; `clip` < 0: at rest.
inline std::vector<humanoid::Placement> placed(const Character& character, int clip, double time = 0.0) {
    if (clip < 0) return placed_as(character.skeleton, rest_pose(character.skeleton));
    return placed_in(character.skeleton, character.clips.at(static_cast<std::size_t>(clip)), time);
}

/// The beginning of a clip.
inline humanoid::Clip first_seconds(humanoid::Clip clip, double seconds) {
    clip.duration = std::min(clip.duration, seconds);
    const auto cut = [&](auto& track) {
        const std::size_t width = track.interpolation == humanoid::Interpolation::Cubic ? 3 : 1;
        while (!track.times.empty() && track.times.back() > seconds) track.times.pop_back();
        track.values.resize(track.times.size() * width);
    };
    for (humanoid::Channel& each : clip.channels) cut(each.translation), cut(each.rotation), cut(each.scale);
    return clip;
}

/// Metres. Throws std::bad_optional_access if there is no such node.
inline glm::dvec3 at(const Character& character, const char* node, int clip, double time = 0.0) {
    return placed(character, clip, time)[character.skeleton.find(node).value()].position;
}

/// The notes, or with the guesses all that the panel shows, one per line.
inline std::string lines(const std::vector<std::string>& sentences) {
    std::string all;
    for (const std::string& each : sentences) all += each + '\n';
    return all;
}

}  // namespace tendril::app::test_posed
