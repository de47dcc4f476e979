// What must hold for a character that a reader accepts, whatever the bytes were.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "app/io/character/character.hpp"
#include "tests/fuzz/check.hpp"

namespace tendril::fuzz {

inline void check_pose(const app::Character& character, const std::vector<rig::Transform>& pose) {
    std::vector<humanoid::Placement> placements(pose.size());
    humanoid::place(character.skeleton, pose, placements);
    for (const rig::Transform& each : pose)
        check(std::isfinite(each.translation.x + each.translation.y + each.translation.z) &&
                  std::isfinite(each.rotation.x + each.rotation.w),
              "a node is somewhere");
}

/// `read` reads the bytes as the file "it". Either it refuses with a message that begins with that name, or
/// it returns a skeleton with clips that can be played.
template <class Read>
void check_character(const Read& read) {
    app::Character character;
    try {
        character = read();
    } catch (const std::runtime_error& error) {
        check(std::string_view(error.what()).starts_with("it"), "a refusal names the file");
        return;
    }
    std::vector<rig::Transform> pose = humanoid::rest_pose(character.skeleton);
    check_pose(character, pose);
    for (std::size_t i = 0; i < std::min<std::size_t>(character.clips.size(), 20); ++i) {
        const humanoid::Clip& clip = character.clips[i];
        check(bool(humanoid::check(clip, character.skeleton)), "a clip holds");
        for (const double part : {0.0, 0.37, 1.0}) {
            humanoid::sample(clip, character.skeleton, part * clip.duration, pose);
            check_pose(character, pose);
        }
    }
}

}  // namespace tendril::fuzz
