// Triangles to draw, free of GL: all solids that are not strokes. All surfaces of a frame are appended to one
// mesh, so that one call draws them.
//
// Triangles are two-sided. Seen from the front, their corners run counter-clockwise; normals point to the
// front.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace tendril::app {

struct Vertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};  ///< unit
    glm::vec3 colour{1.0f};              ///< the front's
    glm::vec3 back{1.0f};                ///< the back's
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;  ///< three to a triangle

    void clear() { vertices.clear(), indices.clear(); }
    /// The index that the next vertex will have.
    std::uint32_t next() const { return static_cast<std::uint32_t>(vertices.size()); }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        indices.insert(indices.end(), {a, b, c});
    }
};

}  // namespace tendril::app
