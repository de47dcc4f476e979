// Reads and writes motion capture in BVH files (Biovision hierarchy; M. Meredith, S. Maddock, "Motion Capture
// File Formats Explained", University of Sheffield, 2001).
//
// The reader accepts any number of roots; any channels in any order at any joint, with rotations multiplied
// in that order; names with blanks; end sites, which become nodes ("LeftToeBase end"); any line ends; and,
// with a note, what some programs write: whole rows beyond the declared frames, other blanks around the
// colons, a ^Z or NUL at the end. A joint's position replaces its OFFSET.
//
// A file does not say whether that is so for the root too, which axis is up or how long its unit is:
// judge_space() finds out (bvh_space.hpp). Memory stays below a constant times the size of the file.
#pragma once

#include <string>
#include <string_view>

#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// `name` is the file's, for messages: `walk.bvh, line 12: expected CHANNELS, found "OFFSET"`. Throws
/// std::runtime_error.
Character parse_bvh(std::string_view text, const std::string& name, LoadProgress* progress = nullptr);

/// The clip at `rate` frames per second from time 0 to its duration, Y up, in metres, or in millimetres for a
/// figure over 4.5 m; parse_bvh() guesses either correctly. Offsets are those of the rest pose, in the
/// character's space, so that all rotations are 0 in the rest pose; a joint whose translation changes has
/// position channels. A node that was read from an end site becomes one again; other nodes without children
/// keep their names and get an end site.
std::string bvh_text(const humanoid::Skeleton& skeleton, const humanoid::Clip& clip, double rate);

}  // namespace tendril::app
