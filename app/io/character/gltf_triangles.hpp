// The triangles of a glTF file's scene, whatever they are part of: for a ground to walk on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

namespace tendril::app {

struct TriangleMesh {
    std::vector<glm::dvec3> vertices;      ///< metres, Y up
    std::vector<std::uint32_t> triangles;  ///< three places in `vertices` each
};

/// Meshes where their nodes put them, as they rest. Throws std::runtime_error that begins with the file's
/// name: what cannot be read, has no triangles, or too many.
TriangleMesh read_triangles(const std::filesystem::path& path);

}  // namespace tendril::app
