// A character as the lab has it: what was read from a file, with what follows from that alone. It never
// changes, and copies of the document share it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tendril/humanoid/lint.hpp>
#include <vector>

#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// A fault of a clip that was mended: all of that kind, or those of one node, or the one at a frame.
struct ClipCure {
    std::string clip;
    humanoid::Fault fault = humanoid::Fault::SignFlip;
    std::string node{};  ///< empty: all
    std::optional<std::size_t> frame{};
    bool operator==(const ClipCure&) const = default;
};

struct LoadedCharacter {
    std::string file;  ///< as it was named; empty: the stick figure
    std::string path;  ///< where that is, whatever the working folder; empty with it
    Character character;
    std::vector<ClipCure> cures{};          ///< what was done to its clips since, in that order
    humanoid::BoneMap matched;              ///< as the file names it, or the library matches it
    std::vector<humanoid::Placement> rest;  ///< of every node
    glm::dvec3 low{0.0}, high{0.0};         ///< of a box around them and the skin, metres
    const humanoid::Skeleton& skeleton() const { return character.skeleton; }
    const std::vector<humanoid::Clip>& clips() const { return character.clips; }
    double height() const { return high.y - low.y; }
};
using SharedCharacter = std::shared_ptr<const LoadedCharacter>;

/// Without a file name the stick figure. Throws std::runtime_error that begins with the file's name.
SharedCharacter load_character(const std::string& file, LoadProgress* progress = nullptr);
/// The same character with so many metres to a unit of its file.
SharedCharacter rescaled(const LoadedCharacter& character, double metres);

}  // namespace tendril::app
