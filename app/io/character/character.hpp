// A character from a file, and its reader: skeleton, skin and clips, converted to Y up and metres.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tendril/humanoid/bone_map.hpp>
#include <tendril/humanoid/clip.hpp>
#include <tendril/humanoid/skeleton.hpp>
#include <vector>

#include "app/io/character/skin.hpp"
#include "app/io/names.hpp"

namespace tendril::app {

/// Progress and cancellation of reading a file, shared between threads.
class LoadProgress {
  public:
    /// Called by the reader: `part` of the file is read, 0 to 1. Throws std::runtime_error if cancelled.
    void at(double part) {
        part_.store(static_cast<float>(part), std::memory_order_relaxed);
        if (cancelled()) throw std::runtime_error("cancelled");
    }
    float part() const { return part_.load(std::memory_order_relaxed); }
    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
    bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

  private:
    std::atomic<float> part_{0.0f};
    std::atomic<bool> cancelled_{false};
};

/// Called by readers; `progress` may be null.
inline void report(LoadProgress* progress, double part) {
    if (progress) progress->at(part);
}

/// The bone assignment stated in a file.
struct NamedBones {
    std::string source{};                                    ///< "VRMC_vrm"
    std::array<std::int32_t, humanoid::bone_count> nodes{};  ///< nodes of the skeleton; -1: none
};

/// The up axis of a file. FBX and glTF files state it; for these, Y means "as stated".
enum class UpAxis : std::uint8_t { X, Y, Z, MinusX, MinusY, MinusZ };

inline constexpr EnumNames<UpAxis, 6> up_axes{
    "axis", {{"x", "X"}, {"y", "Y"}, {"z", "Z"}, {"-x", "-X"}, {"-y", "-Y"}, {"-z", "-Z"}}};

glm::dvec3 direction(UpAxis up);
/// The quarter or half turn that rotates this axis to Y.
glm::dquat turn_of(UpAxis up);

/// The meaning of a BVH root's positions: they replace its OFFSET or are added to it.
enum class RootPositions : std::uint8_t { Replace, Add };

inline constexpr EnumNames<RootPositions, 2> root_positions{
    "positions", {{"replace", "replace OFFSET"}, {"add", "add to OFFSET"}}};

/// How the positions in a file are read.
struct FileSpace {
    UpAxis up = UpAxis::Y;
    RootPositions positions = RootPositions::Replace;
    bool operator==(const FileSpace&) const = default;
};

/// The OFFSET of a root with positions, in the units and axes of its BVH file.
struct RootOffset {
    std::size_t node = 0;
    glm::dvec3 offset{0.0};
};

/// A capsule that keeps springs out, or a sphere if its ends are one point.
struct SpringCollider {
    std::size_t node = 0;           ///< the collider moves with it
    glm::dvec3 from{0.0}, to{0.0};  ///< in the node's space
    double radius = 0.0;            ///< metres
    bool operator==(const SpringCollider&) const = default;
};
/// A spring from the file, on a node and all its descendants; values as in humanoid::SpringOptions.
struct NamedSpring {
    std::size_t node = 0;
    double strength = 0.0;  ///< Hz
    double critical_damping = 0.0;
    double hit_radius = 0.0;  ///< metres
    std::vector<SpringCollider> colliders{};
};

struct Character {
    humanoid::Skeleton skeleton{};
    std::vector<humanoid::Clip> clips{};
    Skin skin{};
    std::optional<NamedBones> bones{};  ///< none: they must be matched
    std::vector<NamedSpring> springs{};
    double scale = 1.0;       ///< metres per unit of the file
    bool states_unit = true;  ///< whether the file does; a BVH never does, some FBX files do not
    FileSpace space{};
    std::vector<RootOffset> root_offsets{};  ///< only those that are not 0
    std::vector<std::string> notes{};        ///< sentences for the panel on omissions and changes
    /// How scale and space were guessed, one sentence each; empty if stated, or set by hand.
    struct Guesses {
        std::string unit{}, up{}, positions{};
    } guesses{};

    /// The guesses, then the notes.
    std::vector<std::string> sentences() const;
};

/// Reads the character's file differently: converts its nodes, skin and clips. The values set here are no
/// longer guesses. Throws std::runtime_error if a number becomes too large.
void read_as(Character& character, double scale, const FileSpace& space);

/// Converts a clip that was made for the character when it was read with `scale` and `space`. Root positions
/// apply only to clips of the character's own file.
humanoid::Clip read_as_now(humanoid::Clip clip, double scale, const FileSpace& space,
                           const Character& character, bool of_its_file);

/// Converts the file's nodes and clips to Y up and metres: rotates the roots and scales every translation.
void normalise(std::vector<humanoid::Node>& nodes, std::vector<humanoid::Clip>& clips, double scale,
               const glm::dquat& turn = {1.0, 0.0, 0.0, 0.0});

/// The file's own bone map or, if it has none, the library's match.
humanoid::BoneMap bone_map(const Character& character);

/// Throws std::runtime_error with the skeleton's message and the name of the node concerned.
humanoid::Skeleton skeleton_of(std::vector<humanoid::Node> nodes);

/// The box around nodes and skin, metres.
struct RestBounds {
    glm::dvec3 low{0.0}, high{0.0};
    double height() const { return high.y - low.y; }
};
/// `rest`: the placements of all nodes at rest.
RestBounds bounds_at_rest(const Character& character, std::span<const humanoid::Placement> rest);

/// A unit of length for files that do not specify one: the common unit that makes a figure of that height
/// closest to 1.75 m.
struct LengthUnit {
    const char* name;
    double metres;
};
LengthUnit guess_unit(double height);

/// An implausible height of a person at rest, and the unit that corrects it.
struct UnitDoubt {
    double height;    ///< metres
    LengthUnit unit;  ///< one of the common units, or a nameless one that makes the person 1.75 m tall
    double then;      ///< the height with that unit
};
/// A character with a usable bone map is a person; a height under 0.5 m or over 3 m is in doubt. `scale`:
/// metres per unit of the file.
std::optional<UnitDoubt> doubted_unit(double height, double scale, const humanoid::BoneMap& map);
/// "This figure is 172.00 m tall at rest; if the file is in centimetres, 1.72 m."
std::string text(const UnitDoubt& doubt);

// Reads a character from any supported file, by its extension: glTF and GLB (including VRM), FBX, BVH.

/// Throws std::runtime_error that begins with the file's name if the file does not exist, has an unknown
/// format, is invalid, has no skeleton, has more nodes than Skeleton::max_nodes, or has a clip that
/// humanoid::check() refuses. May run in its own thread.
Character read_character(const std::filesystem::path& path, LoadProgress* progress = nullptr);

/// The first `most` bytes of such a file, up to 1 GB. Throws std::runtime_error that begins with the file's
/// name.
std::string character_bytes(const std::filesystem::path& path, std::uintmax_t most = UINTMAX_MAX);

/// True if the file name has the extension of a supported file.
bool ends_as_character(const std::filesystem::path& path);

/// Moves feet that hang outside the legs below them (tendril/humanoid/attach.hpp) if that changes no motion,
/// and notes what was done, or why nothing was.
void attach_feet(Character& character);

}  // namespace tendril::app
