// The mesh of an FBX geometry: its polygons as triangles, split by material.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "app/io/character/fbx/record.hpp"

namespace tendril::app::fbx {

/// Triangles of one material. Corners of the same point, normal and texture coordinate are one.
struct MeshPart {
    std::int64_t material = 0;                      ///< counts the model's
    std::vector<std::uint32_t> points{};            ///< for each corner, the geometry's point
    std::vector<glm::vec3> positions{}, normals{};  ///< one per corner; normals may be empty
    std::vector<glm::vec2> uvs{};                   ///< one per corner, v from the bottom; or empty
    std::vector<std::uint32_t> indices{};
};

struct Mesh {
    std::size_t points = 0;
    std::vector<MeshPart> parts{};
};

/// `geometry` has the records Vertices and PolygonVertexIndex. Throws std::runtime_error for a polygon of
/// points that there are not; layers that do not fit are left out.
Mesh read_mesh(const Record& geometry);

}  // namespace tendril::app::fbx
