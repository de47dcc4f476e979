// What the parts of the Rig lab's picture share: the rig as it is, what is selected and hovered, and strokes
// in its colours.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <tendril/rig/hierarchy.hpp>
#include <vector>

#include "app/labs/kit/setting.hpp"
#include "app/labs/lab.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

// What the picture makes of elements beyond their poses: how long a bone is, and which have a body. A bone
// called "head" or "skull" has a head that looks along its z; a null called "blob" is one where the rig has
// the curves "stretch", "bulge" and "hue".

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

struct RigPicture {
    const View& view;
    DrawList& list;
    const RigPart& part;
    const rig::Hierarchy& elements;  ///< with nothing pending
    const Selection& selected = part.selected.elements;

    float px(float pixels) const { return pixels * view.scale; }
    float metres(float pixels, glm::vec3 at) const { return px(pixels) * view.camera.metres_per_pixel(at); }
    /// Metres, but not smaller on the screen than so many pixels.
    float at_least(float size, float pixels, glm::vec3 at) const {
        return std::max(size, metres(pixels, at));
    }
    const std::string& name(std::size_t i) const { return part.rig.definition().elements[i].name; }
    rig::Transform pose(std::size_t i) const { return *elements.known(part.rig.id(i), rig::Space::Global); }
    glm::vec3 point(std::size_t i) const { return glm::vec3(pose(i).translation); }

    bool is_selected(std::size_t i) const { return selected.has(i); }
    bool is_active(std::size_t i) const { return selected.active() == i; }
    /// What is in the way of names and arrowheads: only what is selected alone has one.
    bool has_gizmo(std::size_t i) const { return part.selected.only_element() == i; }
    bool is_lit(std::size_t i) const {
        const PickId pick = view.dragged != no_pick ? view.dragged : view.hovered;
        return pick != no_pick && picked_element(pick) == i;
    }
    /// A colour as it is of what is selected, the active one most of all, or under the pointer.
    glm::vec3 marked(glm::vec3 colour, std::size_t i) const;

    Stroke& line(glm::vec3 a, glm::vec3 b, float width, glm::vec3 colour, PickId pick = no_pick) const;
    void axes(const rig::Transform& pose, float length, float width, Layer layer) const;
    void label(glm::vec3 at, std::string text, glm::vec3 colour, float clearance, int rank) const;
};

/// What was before the incident that is shown; nothing where none is.
void draw_incident(const RigPicture& picture);

/// One control, with its name where that is shown.
void draw_control(const RigPicture& picture, std::size_t element);

// The paths that controls of the Rig lab follow.

void draw_walks(const View& view, DrawList& list);

// What the Rig lab's picture leaves to the person.

LabSetting rig_axes_setting();     ///< the axes of every bone: shown, hidden
LabSetting rig_pending_setting();  ///< which poses are pending: hidden, shown
LabSetting rig_figures_setting();  ///< heads and blobs: shown, hidden
LabSetting rig_strip_setting();    ///< below the scene: the take, the last ten seconds

}  // namespace tendril::app
