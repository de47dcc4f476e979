// The ground that the character walks on, as a person sets it.
#pragma once

#include <memory>
#include <string>
#include <tendril/humanoid/ground.hpp>

#include "app/document/names.hpp"
#include "app/io/character/gltf_triangles.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

inline constexpr EnumNames<humanoid::GroundKind, 6> ground_kinds{
    "kind of ground",
    {{"none", "none", "Nothing to stand on: feet keep to the clip."},
     {"flat", "flat", "Level at 0."},
     {"slope", "slope", "Rises along +Z."},
     {"stairs", "stairs", "Rise along +Z, the first step at 0."},
     {"terrain", "hills", "Low hills, made by calculation."},
     {"mesh", "mesh from a file", "The triangles of a .gltf or .glb file."}}};

inline constexpr double steepest_deg = 80.0, highest_step = 2.0, shortest_step = 0.05, longest_step = 10.0;

/// The triangles of a file. It never changes, and copies share it.
struct GroundMesh {
    std::string path;
    TriangleMesh triangles;
    humanoid::Ground ground;
};
/// Throws std::runtime_error that begins with the file's name.
std::shared_ptr<const GroundMesh> read_ground_mesh(const std::string& path);

/// What is of another kind keeps its value.
struct GroundSetting {
    humanoid::GroundKind kind = humanoid::GroundKind::None;
    double angle_deg = 20.0;                      ///< of the slope, -steepest_deg to steepest_deg
    double step_height = 0.15, step_depth = 0.3;  ///< of the stairs, metres
    std::shared_ptr<const GroundMesh> mesh{};     ///< never null where the kind is mesh
    bool operator==(const GroundSetting&) const = default;
};

/// The hills: 20 m to each side of where the character begins, level there.
humanoid::HeightField hills();

/// Throws std::invalid_argument in the library's words.
humanoid::Ground make_ground(const GroundSetting& setting);

// The ground that the character walks on, where it is more than the level one that the picture has anyway.

/// A piece of it around a point, whose height does not matter.
void draw_ground(const View& view, DrawList& list, const GroundSetting& ground, glm::vec3 around);

}  // namespace tendril::app
