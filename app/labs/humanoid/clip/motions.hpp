// Clips of other files, played on this character (humanoid::retarget). The result is a clip like its own.
#pragma once

#include <string>

#include "app/labs/humanoid/character/loaded_character.hpp"

namespace tendril::app {

struct HumanoidPart;

struct PlayedMotion {
    SharedCharacter loaded;  ///< the part's, with one more clip, the last
    std::string text;        ///< for the user: its name, and what could not be carried over
};

/// Reads the clip of that name from a file of any kind; empty: the first one. `named`: what the user called
/// the file, if it was found elsewhere. Throws std::runtime_error that begins with the file's name.
PlayedMotion with_motion(const HumanoidPart& part, const std::string& file, const std::string& clip,
                         const std::string& named = {});

/// The motion that this clip is; null: a clip of the character's own.
const LoadedMotion* motion_of(const LoadedCharacter& character, std::size_t clip);

}  // namespace tendril::app
