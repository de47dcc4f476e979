// A clip from another character's file, played on a character (humanoid::retarget), with notes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/io/character/character.hpp"

namespace tendril::app {

struct RetargetedMotion {
    humanoid::Clip clip{};  ///< for the character, with its name from its file
    /// First a line on bones that were not retargeted, then lines on scaling and guesses.
    std::vector<std::string> notes{};
};

/// The clip of that name; empty: the first one. Throws std::runtime_error: "walk.bvh: has no clip "run"; it
/// has walk".
const humanoid::Clip& clip_named(const Character& character, const std::filesystem::path& file,
                                 std::string_view name);

/// Throws std::runtime_error that begins with the file's name.
RetargetedMotion retargeted_clip(const Character& source, const humanoid::BoneMap& source_map,
                                 const std::filesystem::path& file, const humanoid::Clip& clip,
                                 const humanoid::Skeleton& skeleton, const humanoid::BoneMap& map);

/// Sentences: how a file without a unit or an up axis was read, and which bones' matches are unsure.
std::vector<std::string> guesses_of(const Character& character, const humanoid::BoneMap& map);

/// One text of several sentences.
std::string joined(std::span<const std::string> sentences);

}  // namespace tendril::app
