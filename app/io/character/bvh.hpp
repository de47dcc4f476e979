// Reads and writes motion capture in BVH files (Biovision hierarchy; M. Meredith, S. Maddock, "Motion Capture
// File Formats Explained", University of Sheffield, 2001).
//
// The reader accepts any number of roots; any channels in any order at any joint, with rotations multiplied
// in that order; names with blanks; end sites, which become nodes ("LeftToeBase end"); any line ends; and,
// with a note, the deviations of some programs: more or fewer rows than the declared frames, other blanks
// around the colons, a ^Z or NUL at the end. A joint's position replaces its OFFSET.
//
// A file does not say whether the root's position also replaces its OFFSET, which axis is up, or how long its
// unit is: judge_space() finds out. Memory stays below a constant times the file's size.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/io/character/character.hpp"

namespace tendril::app {

/// `name` is the file's, for messages: `walk.bvh, line 12: expected CHANNELS, found "OFFSET"`. Throws
/// std::runtime_error.
Character parse_bvh(std::string_view text, const std::string& name, LoadProgress* progress = nullptr);

/// Decides what a file leaves open: which axis points up, whether a root's positions replace its OFFSET or
/// are added to it, how long its unit is, and how the figure stands at rest. Judges by the zero pose and the
/// motion together if it finds legs and a head; otherwise Y is up, positions replace the OFFSET, and only the
/// unit is guessed.
///
/// `nodes` rest in the zero pose, at their OFFSETs. `character` has the motion and the root offsets in the
/// file's units and axes, with the roots' positions unchanged. Sets the scale, the space and the skeleton,
/// converts the motion, and records its guesses.
void judge_space(Character& character, std::vector<humanoid::Node> nodes);

/// The clip at `rate` frames per second from time 0 to its duration, Y up, in metres, or in millimetres for a
/// figure over 4.5 m; parse_bvh() guesses either correctly. Offsets are those of the rest pose, in the
/// character's space, so that all rotations are 0 in the rest pose; a joint whose translation changes has
/// position channels. A node that was read from an end site becomes one again; other nodes without children
/// keep their names and get an end site.
std::string bvh_text(const humanoid::Skeleton& skeleton, const humanoid::Clip& clip, double rate);

}  // namespace tendril::app
