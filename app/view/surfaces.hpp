// Surfaces as triangles: tubes, boxes, cloth, patches of planes. Each function appends to the list's mesh,
// and to its strokes what makes the edges clean as seen by this camera (app/view/edges.hpp) and what throws
// the surface's shadow on the ground; neither can be picked. Balls and capsules are strokes, and need nothing
// from here.
//
// Whatever comes in, what is appended is finite: points that are not, or lie farther than 1e9 from the
// origin, are left out. The same input appends the same. Lengths are in metres, colours in sRGB.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

/// A round tube along the smooth curve through `centres` (app/view/spline.hpp), with `sides` (3 to 64)
/// around, or fewer where that can't be seen, and half a ball at each end. `colours` has one for each centre,
/// and changes evenly between them; where it is shorter the last one holds on.
///
/// The curve is divided as finely as can be seen. Where the tube is thinner than two pixels it is strokes,
/// which fade as they get thinner.
void tube(DrawList& list, const Camera& camera, std::span<const glm::vec3> centres, float radius, int sides,
          std::span<const glm::vec3> colours);

void box(DrawList& list, const Camera& camera, glm::vec3 centre, glm::vec3 half_extents, glm::quat rotation,
         glm::vec3 colour);

/// A cloth of columns x rows points, given row by row. Where the columns run to the right and the rows down,
/// one sees its front.
struct ClothGrid {
    int columns = 0, rows = 0;
    std::span<const glm::vec3> positions;
    /// What is left of each of the (columns - 1) x (rows - 1) cells, row by row; empty: all of it.
    /// ClothGrid::upper is the triangle at the corner nearest to the first point, between the cell's first
    /// row and column; ClothGrid::lower is the other one.
    std::span<const std::uint8_t> cells{};

    static constexpr std::uint8_t upper = 1, lower = 2, whole = 3;
};
/// `colours`, one for each point or none, take the place of `front` and `back`.
void cloth_surface(DrawList& list, const Camera& camera, const ClothGrid& grid, glm::vec3 front,
                   glm::vec3 back, std::span<const glm::vec3> colours = {});

/// A round piece of an endless plane. On the ground it is only a rim, as the ground has its grid and shadows.
void plane_patch(DrawList& list, const Camera& camera, glm::vec3 point, glm::vec3 normal, float radius,
                 glm::vec3 colour);

}  // namespace tendril::app
