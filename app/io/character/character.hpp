// A character as it comes from a file: a skeleton, its clips, and what was done to bring them to Y up and
// metres.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <tendril/humanoid/bone_map.hpp>
#include <tendril/humanoid/clip.hpp>
#include <tendril/humanoid/skeleton.hpp>
#include <vector>

#include "app/io/character/skin.hpp"

namespace tendril::app {

/// What a file itself says of its bones.
struct NamedBones {
    std::string source{};                                    ///< "VRMC_vrm"
    std::array<std::int32_t, humanoid::bone_count> nodes{};  ///< of the skeleton; -1: none
};

struct Character {
    humanoid::Skeleton skeleton{};
    std::vector<humanoid::Clip> clips{};
    Skin skin{};
    std::optional<NamedBones> bones{};  ///< none: they have to be matched
    double scale = 1.0;                 ///< metres of a unit of the file
    char up = 'y';                      ///< the file's axis that points up: x, y or z
    std::vector<std::string> notes{};   ///< sentences for the panel: what was guessed or left out
};

/// Y up and metres: what hangs on nothing is turned, every translation is scaled. `nodes` and `clips` are as
/// the file has them.
void normalise(std::vector<humanoid::Node>& nodes, std::vector<humanoid::Clip>& clips, char up, double scale);

/// As the file says, or else as the library matches them.
humanoid::BoneMap bone_map(const Character& character);

/// Throws std::runtime_error with the skeleton's words and the name of the node that they are about.
humanoid::Skeleton skeleton_of(std::vector<humanoid::Node> nodes);

/// Metres of a unit, for a file that does not say: of the units that people use, the one that makes a figure
/// of that height most nearly 1.75 m. "cm"
struct LengthUnit {
    const char* name;
    double metres;
};
LengthUnit guess_unit(double height);

}  // namespace tendril::app
