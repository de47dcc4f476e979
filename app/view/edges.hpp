// Anti-aliased edges for surfaces without multisampling: along each mesh edge that is an outline as seen from
// the eye, a thin stroke with the surface's colour and light.
//
// The rasteriser fills exactly the pixels whose centres a triangle covers. The stroke, half a pixel to each
// side of the outline, covers the adjacent pixels proportionally, so that together they show the surface half
// a pixel larger with a soft edge. Strokes are drawn after the mesh, far ones first, so the edge blends with
// whatever is behind it. Closed surfaces are built half a pixel smaller to compensate.
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

class Edges {
  public:
    /// Pixels that an edge adds all around.
    static constexpr float width = 0.5f;

    Edges(DrawList& list, const Camera& camera) : list_(list), camera_(camera), first_(list.mesh.next()) {}

    /// The direction from a point towards the eye, not normalised.
    glm::vec3 to_eye(glm::vec3 point) const {
        return camera_.pose().orthographic ? -camera_.forward() : camera_.eye() - point;
    }
    /// Whether a face with this normal, through this point, faces the eye.
    bool front(glm::vec3 normal, glm::vec3 point) const { return glm::dot(normal, to_eye(point)) > 0.0f; }

    /// `width` in metres at a point.
    float metres(glm::vec3 point) const { return width * camera_.metres_per_pixel(point); }

    /// `normal` points to the visible side.
    void outline(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour);
    /// The same between two vertices of the list's mesh.
    void outline(std::uint32_t a, std::uint32_t b, glm::vec3 normal, glm::vec3 colour);
    /// Mitres outlines where exactly two meet in a vertex. Call it after adding all of them.
    void join();
    /// An edge between two visible faces; slightly in front of them, to avoid z-fighting.
    void crease(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour);

    /// A round piece so thin that one shade suffices. Consecutive pieces with the same tangent at their joint
    /// show no seams, even where they are so thin that they fade.
    void thread(glm::vec3 a, glm::vec3 b, glm::vec3 tangent_a, glm::vec3 tangent_b, float radius,
                glm::vec3 colour);

  private:
    /// An outline between two vertices, and its stroke.
    struct Joined {
        std::uint32_t a, b;
        std::size_t stroke;
    };
    /// A vertex where outlines end: their count, and the other ends of the first two.
    struct Joint {
        std::uint32_t count = 0;
        std::uint32_t others[2]{};
        glm::vec2 pixel{0.0f};
    };
    void meet(std::uint32_t vertex, std::uint32_t other);
    const Joint& joint(std::uint32_t vertex) const { return joints_[slots_[vertex - first_] - 1]; }
    float mitre_at(std::uint32_t vertex, std::uint32_t other) const;

    float mitre(glm::vec3 point, glm::vec3 tangent, glm::vec3 direction) const;
    Stroke& add(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour);

    DrawList& list_;
    const Camera& camera_;
    std::uint32_t first_;  ///< earlier vertices belong to other surfaces
    std::vector<Joined> joined_;
    std::vector<Joint> joints_;
    std::vector<std::uint32_t> slots_;  ///< for each vertex: its joint's number, from 1; 0: none
};

}  // namespace tendril::app
