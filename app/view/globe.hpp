// A closed round surface of any shape, as triangles: a head, a blob. Like the builders in surfaces.hpp it
// appends to the list's mesh, and to its strokes what makes its outline clean; it throws no shadow and cannot
// be picked.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

/// `surface` says where the point of the unit ball that it is given lies, in metres; outside stays outside.
/// Normals are those of the triangles around a point, weighted by their areas. Where any point is not finite
/// or farther than 1e9 from the origin, nothing is appended. Some 2 500 points, each asked for once.
void globe(DrawList& list, const Camera& camera, const std::function<glm::vec3(glm::vec3)>& surface,
           glm::vec3 colour);

}  // namespace tendril::app
