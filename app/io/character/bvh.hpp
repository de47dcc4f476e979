// Reads and writes motion capture in BVH files (Biovision hierarchy; M. Meredith, S. Maddock, "Motion Capture
// File Formats Explained", University of Sheffield, 2001).
//
// The reader accepts any number of roots; any channels in any order at any joint, with rotations multiplied
// in that order; names with blanks; end sites, which become nodes ("LeftToeBase end"); any line ends. Where
// the text above is ambiguous it follows the programs that write such files: a root's position is added to
// its offset, another joint's position replaces the offset. A BVH has no unit: it is guessed from the
// figure's height.
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
