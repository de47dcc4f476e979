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

/// Carries over the clip of that name, empty: the first one, of a character read from `file`. Throws
/// std::runtime_error that begins with the file's name.
PlayedMotion with_motion(const HumanoidPart& part, const Character& source, const OutsideFile& file,
                         const std::string& clip);

/// The motion that this clip is; null: a clip of the character's own.
const LoadedMotion* motion_of(const LoadedCharacter& character, std::size_t clip);

}  // namespace tendril::app
