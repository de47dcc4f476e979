// A clip of another character's file, played on a character (humanoid::retarget), and what that took.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/io/character/character.hpp"

namespace tendril::app {

struct RetargetedMotion {
    humanoid::Clip clip{};  ///< of the character; has the name that it has in its file
    /// The first is a line on what was not retargeted; then what was scaled, and what was guessed.
    std::vector<std::string> notes{};
};

/// The clip of that name; empty: the first one. Throws std::runtime_error: "walk.bvh: has no clip "run"; it
/// has walk".
const humanoid::Clip& clip_named(const Character& character, const std::filesystem::path& file,
                                 std::string_view name);

/// Throws std::runtime_error that begins with the file's name.
RetargetedMotion retargeted_clip(const Character& source, const std::filesystem::path& file,
                                 const humanoid::Clip& clip, const humanoid::Skeleton& skeleton,
                                 const humanoid::BoneMap& map);

/// In sentences: how a file without a unit or an up axis was read, and which bones its nodes hardly show.
std::vector<std::string> guesses_of(const Character& character, const humanoid::BoneMap& map);

/// One text of several sentences.
std::string joined(std::span<const std::string> sentences);

}  // namespace tendril::app
