// Clean edges for surfaces without multisampling: along each edge of a mesh that is an outline as seen from
// the eye, a thin stroke that takes its colour and light from the surface.
//
// The rasteriser draws the pixels whose centres a triangle covers, all or nothing. The stroke, half a pixel
// to each side of the outline, covers the pixels next to those in proportion, so that together they are the
// surface made half a pixel larger with a soft edge. Strokes are drawn after the mesh, the far ones first, so
// the edge is soft over whatever is behind. A closed surface is built that half pixel smaller beforehand.
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

    /// From a point towards the eye, of any length.
    glm::vec3 to_eye(glm::vec3 point) const {
        return camera_.pose().orthographic ? -camera_.forward() : camera_.eye() - point;
    }
    /// Whether a face with that normal and that point in its plane shows its front.
    bool front(glm::vec3 normal, glm::vec3 point) const { return glm::dot(normal, to_eye(point)) > 0.0f; }

    /// What `width` is at that point, in metres.
    float metres(glm::vec3 point) const { return width * camera_.metres_per_pixel(point); }

    /// `normal` points to the side that is seen.
    void outline(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour);
    /// The same between two vertices of the mesh.
    void outline(std::uint32_t a, std::uint32_t b, glm::vec3 normal, glm::vec3 colour);
    /// Cuts those where two meet in a vertex so that they fit together. Call it when all are there.
    void join();
    /// Between two faces that both are seen; lies a little before them, as it would drown in them.
    void crease(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour);

    /// A round piece so thin that one shade is enough for all of it. Pieces that go on in one another, with
    /// the same tangent where they meet, show no seams, also where they are so thin that they fade.
    void thread(glm::vec3 a, glm::vec3 b, glm::vec3 tangent_a, glm::vec3 tangent_b, float radius,
                glm::vec3 colour);

  private:
    /// An outline between two vertices, and its stroke.
    struct Joined {
        std::uint32_t a, b;
        std::size_t stroke;
    };
    /// A vertex where outlines end: how many, and at which vertices the first two begin.
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
    std::uint32_t first_;  ///< vertices before this one are not ours
    std::vector<Joined> joined_;
    std::vector<Joint> joints_;
    std::vector<std::uint32_t> slots_;  ///< of each vertex: its joint's number, from 1
};

}  // namespace tendril::app
