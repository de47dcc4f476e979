// Motion capture in BVH files (Biovision's hierarchy; M. Meredith, S. Maddock, "Motion Capture File Formats
// Explained", University of Sheffield, 2001), read and written.
//
// What is read: any number of roots; any channels in any order at any joint, rotations multiplied in the
// order in which they stand; names with blanks; end sites, as nodes of their own ("LeftToeBase end"); any
// line ends. What the text above leaves open is done as the programs that write such files do: a root's
// position is added to its offset, that of another joint takes the offset's place. A BVH has no unit: it is
// guessed from the height of the figure.
#pragma once

#include <string>
#include <string_view>

#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// `name` is the file's, for messages: `walk.bvh, line 12: expected CHANNELS, found "OFFSET"`. Throws
/// std::runtime_error.
Character parse_bvh(std::string_view text, const std::string& name, LoadProgress* progress = nullptr);

/// The clip at `rate` frames a second from time 0 up to its duration, Y up, in metres; in millimetres where
/// the figure is over 4.5 m, which is what parse_bvh() guesses then. Offsets are those of the rest pose, in
/// the character's space, so that with all rotations 0 the figure stands as it rests; a joint whose
/// translation moves has position channels. A node that was read from an end site becomes one again; any
/// other without children keeps its name and gets an end site.
std::string bvh_text(const humanoid::Skeleton& skeleton, const humanoid::Clip& clip, double rate);

}  // namespace tendril::app
