// Surfaces as triangles, with the curves and the soft edges that they are made of: tubes, boxes, cloth,
// globes, patches of planes. Each function appends triangles to the list's mesh, and strokes that anti-alias
// the edges for this camera and cast the shadow on the ground; none can be picked. Balls and capsules are
// strokes, not surfaces.
//
// The output is always finite: points that are not finite, or have a coordinate beyond 1e9, are omitted.
// Deterministic. Lengths are in metres, colours in sRGB.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

/// A round tube along the smooth curve through `centres`, with at most `sides` (3 to
/// 64) sides, fewer if that looks the same, and a hemisphere at each end. `colours` has one per centre and is
/// interpolated linearly; if it is shorter, the last one continues.
///
/// The curve is subdivided as finely as can be seen. Where the tube is thinner than two pixels it becomes
/// strokes, which fade as they get thinner.
void tube(DrawList& list, const Camera& camera, std::span<const glm::vec3> centres, float radius, int sides,
          std::span<const glm::vec3> colours);

void box(DrawList& list, const Camera& camera, glm::vec3 centre, glm::vec3 half_extents, glm::quat rotation,
         glm::vec3 colour);

/// A cloth of columns x rows points, given row by row. The front is the side from which columns run right and
/// rows down.
struct ClothGrid {
    int columns = 0, rows = 0;
    std::span<const glm::vec3> positions;
    /// The remaining triangles of each of the (columns - 1) x (rows - 1) cells, row by row; empty: all.
    /// `upper` is the triangle at the cell's first row and column, `lower` the other one.
    std::span<const std::uint8_t> cells{};

    static constexpr std::uint8_t upper = 1, lower = 2, whole = 3;
};
/// `colours`, one per point or empty, replace `front` and `back`.
void cloth_surface(DrawList& list, const Camera& camera, const ClothGrid& grid, glm::vec3 front,
                   glm::vec3 back, std::span<const glm::vec3> colours = {});

/// A round piece of an infinite plane. On the ground only the rim is drawn, since the ground has its grid and
/// shadows.
void plane_patch(DrawList& list, const Camera& camera, glm::vec3 point, glm::vec3 normal, float radius,
                 glm::vec3 colour);

// Shared helpers of the surface builders.

/// Limit of coordinates, metres: fourth powers are still finite.
inline constexpr float farthest_built = 1e9f;

inline bool can_be_built(glm::vec3 point) {
    return std::abs(point.x) <= farthest_built && std::abs(point.y) <= farthest_built &&
           std::abs(point.z) <= farthest_built;
}

inline glm::vec3 unit_or(glm::vec3 vector, glm::vec3 fallback) {
    const float length = glm::length(vector);
    return length > 1e-30f && std::isfinite(length) ? vector / length : fallback;
}

/// Casts the shadow of an invisible capsule.
inline void cast(DrawList& list, glm::vec3 a, glm::vec3 b, float radius) {
    list.bone(a, b, radius, radius, glm::vec4(0.0f)).shadow = true;
}

// A closed round surface of any shape: a head, a blob. It casts no shadow.

/// `surface` maps points of the unit sphere to positions in metres and must not turn the sphere inside out. A
/// vertex normal is the area-weighted mean of its triangles' normals. Appends nothing if any point is not
/// finite or has a coordinate beyond 1e9. Calls `surface` once for each of about 2 400 points.
void globe(DrawList& list, const Camera& camera, const std::function<glm::vec3(glm::vec3)>& surface,
           glm::vec3 colour);

// A smooth curve through points, with twist-free frames: the centre line of a tube.
//
// The curve is the centripetal Catmull-Rom spline (E. Catmull, R. Rom, "A class of local interpolating
// splines", 1974; knots by C. Yuksel, S. Schaefer, J. Keyser, "Parameterization and applications of
// Catmull-Rom curves", 2011): it passes through all points and has neither cusps nor loops between two of
// them. The frames turn about the curve as little as possible: W. Wang, B. Juettler, D. Zheng, Y. Liu,
// "Computation of rotation minimizing frames", 2008, the double reflection method. O(n).

/// A point of the curve.
struct CurvePoint {
    glm::vec3 at{0.0f};
    glm::vec3 tangent{1.0f, 0.0f, 0.0f};  ///< unit
    glm::vec3 normal{0.0f, 1.0f, 0.0f};   ///< unit, perpendicular; the third axis is cross(tangent, normal)
    float along = 0.0f;                   ///< index of the given point, with a fraction between two
};

/// One piece of the curve, between two neighbouring points: a cubic with these derivatives at its ends.
struct CurveSpan {
    glm::vec3 a{0.0f}, b{0.0f};
    glm::vec3 slope_a{0.0f}, slope_b{0.0f};

    glm::vec3 at(float t) const;
    glm::vec3 slope(float t) const;
    /// Approximate turning angle in radians: from the first direction to the chord's, then to the last.
    float turn() const;
};

/// The piece from points[i] to points[i + 1]. Consecutive points must not coincide, nor be farther than 1e9
/// from the origin.
CurveSpan curve_span(std::span<const glm::vec3> points, std::size_t i);

/// Sets the normals of points whose positions and tangents are set. The first normal depends only on the
/// first tangent, continuously except at one unlikely direction, so that a moving curve keeps its frames.
void set_frames(std::span<CurvePoint> points);

/// Anti-aliased edges for surfaces without multisampling: along each mesh edge that is an outline as seen
/// from the eye, a thin stroke with the surface's colour and light.
///
/// The rasteriser fills exactly the pixels whose centres a triangle covers. The stroke, half a pixel to each
/// side of the outline, covers the adjacent pixels proportionally, so that together they show the surface
/// half a pixel larger with a soft edge. Strokes are drawn after the mesh, far ones first, so the edge blends
/// with whatever is behind it. Closed surfaces are built half a pixel smaller to compensate.
class Edges {
  public:
    /// Pixels that an edge adds all around.
    static constexpr float width = 0.5f;

    Edges(DrawList& list, const Camera& camera) : list_(list), camera_(camera), first_(list.mesh.next()) {}

    /// The direction from a point towards the eye, not normalised.
    glm::vec3 to_eye(glm::vec3 point) const {
        return camera_.pose().orthographic ? -camera_.forward() : camera_.eye() - point;
    }
    /// True if a face with this normal, through this point, faces the eye.
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
    /// show no seam, even when they are so thin that they fade.
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
