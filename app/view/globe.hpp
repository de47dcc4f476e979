// A closed round surface of any shape, as triangles: a head, a blob. Like the builders in surfaces.hpp it
// appends to the list's mesh, and strokes for an anti-aliased outline; it casts no shadow and cannot be
// picked.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

/// `surface` maps points of the unit sphere to positions in metres and must not turn the sphere inside out. A
/// vertex normal is the area-weighted mean of its triangles' normals. Appends nothing if any point is not
/// finite or has a coordinate beyond 1e9. Calls `surface` once for each of about 2 400 points.
void globe(DrawList& list, const Camera& camera, const std::function<glm::vec3(glm::vec3)>& surface,
           glm::vec3 colour);

}  // namespace tendril::app
