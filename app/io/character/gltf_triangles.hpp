// All triangles of a glTF file's scene, for a ground to walk on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

namespace tendril::app {

struct TriangleMesh {
    std::vector<glm::dvec3> vertices;      ///< metres, Y up
    std::vector<std::uint32_t> triangles;  ///< three indices into `vertices` each
};

/// The meshes as placed by their nodes, at rest. Throws std::runtime_error that begins with the file's name
/// if the file cannot be read, or has no triangles or too many.
TriangleMesh read_triangles(const std::filesystem::path& path);

}  // namespace tendril::app
