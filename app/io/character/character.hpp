// A character from a file: its skeleton, skin and clips, converted to Y up and metres.
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

/// The file's own assignment of bones.
struct NamedBones {
    std::string source{};                                    ///< "VRMC_vrm"
    std::array<std::int32_t, humanoid::bone_count> nodes{};  ///< nodes of the skeleton; -1: none
};

/// A spring of the file on a node and all its descendants, as humanoid::SpringOptions.
struct NamedSpring {
    std::size_t node = 0;
    double strength = 0.0;  ///< Hz
    double critical_damping = 0.0;
};

struct Character {
    humanoid::Skeleton skeleton{};
    std::vector<humanoid::Clip> clips{};
    Skin skin{};
    std::optional<NamedBones> bones{};  ///< none: they must be matched
    std::vector<NamedSpring> springs{};
    double scale = 1.0;                 ///< metres per unit of the file
    std::vector<std::string> notes{};   ///< sentences for the panel: what was guessed or omitted
};

/// Converts the file's nodes and clips to Y up and metres: rotates the roots and scales every translation.
void normalise(std::vector<humanoid::Node>& nodes, std::vector<humanoid::Clip>& clips, double scale,
               const glm::dquat& turn = {1.0, 0.0, 0.0, 0.0});

/// The file's own bone map, or else the library's match.
humanoid::BoneMap bone_map(const Character& character);

/// Throws std::runtime_error with the skeleton's message and the name of the node concerned.
humanoid::Skeleton skeleton_of(std::vector<humanoid::Node> nodes);

/// A unit of length for files that do not specify one: of the common units, the one that makes a figure of
/// that height closest to 1.75 m.
struct LengthUnit {
    const char* name;
    double metres;
};
LengthUnit guess_unit(double height);

}  // namespace tendril::app
