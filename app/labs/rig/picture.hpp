// What the parts of the Rig lab's picture share: the rig as it is, what is selected and hovered, and strokes
// in its colours.
#pragma once

#include <glm/geometric.hpp>
#include <optional>
#include <string>

#include "app/labs/rig/figure.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

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

}  // namespace tendril::app
