// Shared by the drawing code of the Rig lab: the rig, selection and hover state, and strokes in its colours.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <tendril/rig/hierarchy.hpp>
#include <vector>

#include "app/labs/kit/setting.hpp"
#include "app/labs/lab.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

// Figures drawn over the poses. A bone named "head" or "skull" is drawn as a head facing along z, with lids
// and mouth moved by the curves "blink" and "mouth"; a null named "blob" as a blob, if there are curves
// "stretch", "bulge" and "hue".

// Each element has its own pick id, and a rotation control one for each of its rings.
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

/// Global end points of a bone: its child bones or, if it has none, a point a short way beyond it.
std::vector<glm::dvec3> bone_ends(const rig::Hierarchy& elements, rig::ElementId bone);
/// The mean distance to those end points, metres.
double bone_size(const rig::Hierarchy& elements, rig::ElementId bone);

/// The radius of a head, metres; the bones that end on it protrude slightly.
double head_radius(const rig::Hierarchy& elements, rig::ElementId bone);

/// A bounding sphere for framing the view.
Bounds figure_bounds(const RigPart& part, const rig::Hierarchy& elements, std::size_t element);

// Drawn solid in palette colours, with the pick id of the element.
// / A face's state, 0 to 1: the rig's curves "blink" and "mouth", if they exist.
struct Face {
    float blink = 0.0f;  ///< 1: the lids are closed
    float mouth = 0.0f;  ///< 1: wide open
};
Face face_of(const RigPart& part);
void draw_head(const View& view, DrawList& list, const rig::Transform& pose, double radius, const Face& face,
               glm::vec3 colour, PickId pick);
void draw_blob(const View& view, DrawList& list, const rig::Transform& pose, const RigPart& part,
               glm::vec3 tint, float tinted, PickId pick);

struct RigPicture {
    const View& view;
    DrawList& list;
    const RigPart& part;
    const rig::Hierarchy& elements;  ///< nothing pending
    const Selection& selected = part.selected.elements;

    float px(float pixels) const { return pixels * view.scale; }
    float metres(float pixels, glm::vec3 at) const { return px(pixels) * view.camera.metres_per_pixel(at); }
    /// Metres, but at least `pixels` on the screen.
    float at_least(float size, float pixels, glm::vec3 at) const {
        return std::max(size, metres(pixels, at));
    }
    const std::string& name(std::size_t i) const { return part.rig.definition().elements[i].name; }
    rig::Transform pose(std::size_t i) const { return *elements.known(part.rig.id(i), rig::Space::Global); }
    glm::vec3 point(std::size_t i) const { return glm::vec3(pose(i).translation); }

    bool is_selected(std::size_t i) const { return view.handles && selected.has(i); }
    bool is_active(std::size_t i) const { return view.handles && selected.active() == i; }
    /// Names and arrowheads keep clear of the gizmo, which is shown only if one element is selected.
    bool has_gizmo(std::size_t i) const { return part.selected.only_element() == i; }
    bool is_lit(std::size_t i) const {
        const PickId pick = view.dragged != no_pick ? view.dragged : view.hovered;
        return pick != no_pick && picked_element(pick) == i;
    }
    /// The colour, highlighted if the element is selected (more if it is active) or under the pointer.
    glm::vec3 marked(glm::vec3 colour, std::size_t i) const;

    Stroke& line(glm::vec3 a, glm::vec3 b, float width, glm::vec3 colour, PickId pick = no_pick) const;
    void axes(const rig::Transform& pose, float length, float width, Layer layer) const;
    void label(glm::vec3 at, std::string text, glm::vec3 colour, float clearance, int rank) const;
};

/// The skeleton before the incident on display; draws nothing if there is none.
void draw_incident(const RigPicture& picture);

/// Draws a control, with its name if that is shown.
void draw_control(const RigPicture& picture, std::size_t element);

// The paths that controls follow.

void draw_walks(const View& view, DrawList& list);

// User settings of the drawing.

LabSetting rig_axes_setting();     ///< the axes of every bone: shown, hidden
LabSetting rig_pending_setting();  ///< marks of pending poses: hidden, shown
LabSetting rig_figures_setting();  ///< heads and blobs: shown, hidden
LabSetting rig_strip_setting();    ///< the strip below the scene: the take, or the last ten seconds

}  // namespace tendril::app
