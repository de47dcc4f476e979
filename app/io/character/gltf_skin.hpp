// The meshes of a glTF file: as a skin, bound to the skeleton's nodes, and as plain triangles.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "app/io/character/gltf_keys.hpp"
#include "app/io/character/skin.hpp"
#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

struct GltfNodes {
    std::vector<std::int32_t> parents;  ///< parents of the file's nodes
    std::vector<std::int32_t> place;    ///< index in the skeleton of each of the file's nodes; -1: not in it
};

/// `local` has the local transform of each of the file's nodes. Omits meshes with no ancestor in the
/// skeleton, points and lines, and compressed meshes; a surface whose picture cannot be read is grey. Counts
/// dropped morph keys. Appends sentences about other omissions to `notes`. Throws std::runtime_error.
Skin gltf_skin(const tinygltf::Model& model, const GltfNodes& nodes,
               const std::vector<humanoid::Placement>& local, DroppedKeys& dropped,
               std::vector<std::string>& notes);

/// All triangles of a glTF file's scene, for a ground to walk on.
struct TriangleMesh {
    std::vector<glm::dvec3> vertices;      ///< metres, Y up
    std::vector<std::uint32_t> triangles;  ///< three indices into `vertices` each
};

/// The meshes as placed by their nodes, at rest. Throws std::runtime_error that begins with the file's name
/// if the file cannot be read, or has no triangles or too many.
TriangleMesh read_triangles(const std::filesystem::path& path);

}  // namespace tendril::app
