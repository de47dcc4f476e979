// The user's setting of the ground that the character walks on, and its drawing.
#pragma once

#include <memory>
#include <string>
#include <tendril/humanoid/ground.hpp>

#include "app/document/names.hpp"
#include "app/document/outside_file.hpp"
#include "app/io/character/gltf_triangles.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

inline constexpr EnumNames<humanoid::GroundKind, 6> ground_kinds{
    "kind of ground",
    {{"none", "none", "Nothing to stand on: feet keep to the clip."},
     {"flat", "flat", "Level at 0."},
     {"slope", "slope", "Rises along +Z."},
     {"stairs", "stairs", "Rise along +Z, the first step at 0."},
     {"terrain", "hills", "Low hills, generated."},
     {"mesh", "mesh from a file", "The triangles of a .gltf or .glb file."}}};

inline constexpr double steepest_deg = 80.0, highest_step = 2.0, shortest_step = 0.05, longest_step = 10.0;

/// The triangles of a file. Immutable; copies share it.
struct GroundMesh : OutsideFile {
    TriangleMesh triangles;
    humanoid::Ground ground;
};
/// `file`: the user's name for the file, if it differs from its path. Throws std::runtime_error that begins
/// with the file name.
std::shared_ptr<const GroundMesh> read_ground_mesh(const std::string& path, const std::string& file = {});

/// Values that belong to other kinds are kept.
struct GroundSetting {
    humanoid::GroundKind kind = humanoid::GroundKind::None;
    double angle_deg = 20.0;                      ///< of the slope, -steepest_deg to steepest_deg
    double step_height = 0.15, step_depth = 0.3;  ///< of the stairs, metres
    std::shared_ptr<const GroundMesh> mesh{};     ///< never null if the kind is Mesh
    bool operator==(const GroundSetting&) const = default;
};

/// The hills: 20 m in each direction from the start of the character, where they are level.
humanoid::HeightField hills();

/// Throws std::invalid_argument with the library's message.
humanoid::Ground make_ground(const GroundSetting& setting);

// Drawing of the ground, except for the level ground that every scene shows.

/// Draws the part around a point, whose height is ignored.
void draw_ground(const View& view, DrawList& list, const GroundSetting& ground, glm::vec3 around);

}  // namespace tendril::app
