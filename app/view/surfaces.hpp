// Surfaces as triangles: tubes, boxes, cloth, patches of planes. Each function appends triangles to the
// list's mesh, and strokes that anti-alias the edges for this camera (app/view/edges.hpp) and cast the shadow
// on the ground; none can be picked. Balls and capsules are strokes, not surfaces.
//
// The output is always finite: points that are not, or have a coordinate beyond 1e9, are omitted.
// Deterministic. Lengths are in metres, colours in sRGB.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

/// A round tube along the smooth curve through `centres` (app/view/spline.hpp), with at most `sides` (3 to
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

}  // namespace tendril::app
