// What the picture makes of elements beyond their poses: how long a bone is, and which have a body. A bone
// called "head" or "skull" has a head that looks along its z; a null called "blob" is one where the rig has
// the curves "stretch", "bulge" and "hue".
#pragma once

#include <glm/vec3.hpp>
#include <tendril/rig/hierarchy.hpp>
#include <vector>

#include "app/labs/lab.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

// Each element has a pick of its own, and a control that is turned one for each of its rings.
constexpr PickId element_pick(std::size_t element, int ring = -1) {
    return static_cast<PickId>(4 * element) + ring + 1;
}
constexpr std::size_t picked_element(PickId pick) {
    return static_cast<std::size_t>(pick) / 4;
}
constexpr int picked_ring(PickId pick) {
    return pick % 4 - 1;
}

enum class Figure : std::uint8_t { None, Head, Blob };
Figure figure_of(const RigPart& part, std::size_t element);

/// Where the pieces of a bone end, global: at the bones below it, or where it has none a little way on.
std::vector<glm::dvec3> bone_ends(const rig::Hierarchy& elements, rig::ElementId bone);
/// The mean length of those pieces, metres.
double bone_size(const rig::Hierarchy& elements, rig::ElementId bone);

/// Of a head, metres: the bones that end on it reach a little out of it.
double head_radius(const rig::Hierarchy& elements, rig::ElementId bone);

/// A sphere around it, of which to frame all.
Bounds figure_bounds(const RigPart& part, const rig::Hierarchy& elements, std::size_t element);

// Drawn solid, in the colours of the palette; picked as their element.
void draw_head(const View& view, DrawList& list, const rig::Transform& pose, double radius, glm::vec3 colour,
               PickId pick);
void draw_blob(const View& view, DrawList& list, const rig::Transform& pose, const RigPart& part,
               glm::vec3 tint, float tinted, PickId pick);

}  // namespace tendril::app
