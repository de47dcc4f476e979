// How the Linkage lab is drawn, and what its picks mean.
#pragma once

#include <glm/vec2.hpp>
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

/// A point of the linkage in the scene, and back. Mechanisms in space have Z upwards, the scene Y.
glm::vec3 in_scene(const LinkagePart& part, const glm::dvec3& at);
glm::vec3 from_scene(const LinkagePart& part, const glm::vec3& at);

/// Where a link is joined to others, in the present pose, in the scene.
std::vector<glm::vec3> places_on(const LinkagePart& part, std::size_t link);
/// The linkage through all its turn, with its targets.
Bounds linkage_bounds(const Workspace& workspace);
/// Frames that: square on to its plane, or from the side.
void look_at_linkage(Workspace& workspace);
/// Frames it as it is looked at, if part of it is out of view.
void keep_linkage_in_view(Workspace& workspace);

/// From slow to fast.
glm::vec3 speed_colour(const Palette& palette, double share);

}  // namespace tendril::app
