// Drawing of the Linkage lab, and the meaning of its pick ids.
#pragma once

#include <glm/vec3.hpp>

#include "app/labs/lab.hpp"
#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {

/// Pick ids: points by their index, then their targets.
inline PickId linkage_pick(std::size_t point) {
    return static_cast<PickId>(point);
}
inline PickId linkage_target_pick(std::size_t target) {
    return static_cast<PickId>(ik::max_links + target);
}

/// Converts points between linkage and scene. Mechanisms in space have Z up, the scene has Y up.
glm::vec3 in_scene(const LinkagePart& part, const glm::dvec3& at);
glm::vec3 from_scene(const LinkagePart& part, const glm::vec3& at);

/// The points where a link is joined to others, in the present pose, in scene coordinates.
std::vector<glm::vec3> places_on(const LinkagePart& part, std::size_t link);
/// Bounds of the linkage through its whole turn, and of its targets.
Bounds linkage_bounds(const Workspace& workspace);
/// Frames these bounds: a planar linkage square on, a walker or a mechanism in space from the side.
void look_at_linkage(Workspace& workspace);
/// Frames the same bounds from the present direction if part of them is out of view.
void keep_linkage_in_view(Workspace& workspace);

/// The speed along a path, m/s, with the colour of fast: the highest, but at most three times the mean. Next
/// to a dead point everything else would look slow.
struct PathSpeed {
    double fast = 0.0;
    bool exceeded = false;  ///< the point is faster somewhere
};
PathSpeed path_speed(const std::vector<PathPoint>& path);

}  // namespace tendril::app
