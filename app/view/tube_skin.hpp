// The surface of a tube, built from its circles: bands of triangles from each to the next, the outline for
// this camera, and threads where the tube is thin.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "app/view/surfaces.hpp"

namespace tendril::app {

/// One circle of a tube. The hemispheres at its ends consist of circles whose normals lean towards the poles.
struct Ring {
    glm::vec3 centre{0.0f};
    glm::vec3 axis{0.0f}, u{0.0f}, v{0.0f};  ///< unit; the circle runs from u to v
    float radius = 0.0f;                     ///< the circle's, metres
    float lean = 0.0f;                       ///< radians that the surface's normal leans towards the axis
    float tube_radius = 0.0f;                ///< metres
    float pixels = 0.0f;                     ///< the tube's radius in pixels
    unsigned outside = 0;  ///< the view's borders that the ring is beyond, one bit per border
    bool first = false;    ///< no band connects it to the previous ring
    glm::vec3 colour{1.0f};
};

class TubeSkin {
  public:
    static constexpr int max_sides = 64;

    TubeSkin(DrawList& list, const Camera& camera, int sides);

    /// Omits sides that face away from the eye: the tube is closed, so they are invisible.
    void cover(std::span<const Ring> rings);

  private:
    /// Inside: in bends sharper than the tube's radius the inner side lies inside the tube.
    enum class Facing : std::uint8_t { Away, Front, Inside };
    using PerSide = std::array<Facing, max_sides>;

    std::uint32_t corners(const Ring& ring);
    void band(std::uint32_t from, std::uint32_t to, bool joined);
    Facing facing(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    void edge(Facing one, Facing other, std::uint32_t a, std::uint32_t b);
    glm::vec3 at(std::uint32_t vertex) const { return list_.mesh.vertices[vertex].position; }
    std::uint32_t after(std::uint32_t side) const { return side + 1 == sides_ ? 0 : side + 1; }

    DrawList& list_;
    Edges edges_;
    std::uint32_t sides_;
    std::array<glm::vec2, max_sides> circle_{};
    PerSide last_{};         ///< the last band's
    float outwards_ = 1.0f;  ///< radius of the outline's centre line, relative to the last ring's
};

}  // namespace tendril::app
