// Dragging one part of a gizmo: converts lines of sight to frames, without window or drawing.
//
// Everything is measured in the plane through the centre that faces the eye, which every line of sight meets
// nearby. Points on an axis or plane follow from there by perspective, so the grabbed point stays under the
// pointer. Where an axis points at the eye, a plane is edge-on, or the pointer nears a plane's horizon, one
// pixel would span kilometres; there the drag continues linearly. So a small move of the pointer is always a
// small move of the frame.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "app/view/gizmo.hpp"

namespace tendril::app {

class GizmoDrag {
  public:
    /// `caught`: the line of sight where the part was grabbed. `reach`: metres from the centre to the ring or
    /// the box; dragging a box by that much doubles the scale. `orthographic`: lines of sight are parallel.
    GizmoDrag(GizmoPart part, const HandleFrame& frame, const Ray& caught, float reach, bool orthographic);

    /// The frame for a line of sight. A ring counts its turns from call to call, at most half a turn each.
    /// Returns the last frame if the line of sight is unusable (not finite, or pointing away).
    HandleFrame to(const Ray& ray);

    /// `now` with the property that the part changes taken from `dragged`: the rotation, the scale along the
    /// axis, or the position along the arrow or in the plane.
    HandleFrame changed(const HandleFrame& now, const HandleFrame& dragged) const;

    GizmoPart part() const { return part_; }
    const HandleFrame& from() const { return from_; }
    /// For a ring: radians since it was caught, including whole turns.
    double turned() const { return turned_; }
    /// For a ring: the angle where it was grabbed, in radians about its axis.
    double caught_at() const { return caught_at_; }
    /// Describes the change so far, to `now`: "35.2° about X", "0.25 m along X", "1.50 times along X".
    std::string text(const HandleFrame& now) const;

  private:
    std::optional<glm::vec3> facing(const Ray& ray) const;
    glm::vec2 measured(glm::vec3 at) const;
    float along_axis(glm::vec3 at, glm::vec3 axis) const;
    glm::vec2 in_plane(glm::vec3 at) const;
    float about_axis(glm::vec3 at) const;

    GizmoPart part_;
    HandleFrame from_, last_;
    glm::vec3 axis_, u_, v_;  ///< the part's axis (along, about, or the plane's normal) and the two others
    glm::vec3 sight_;         ///< unit, from the eye to the centre
    float distance_ = 1.0f;   ///< from the eye to the centre
    float inverse_distance_ = 0.0f;  ///< inverse distance; 0 if lines of sight are parallel
    float reach_;
    bool edge_on_ = false;  ///< the ring is seen nearly edge-on
    glm::vec2 caught_{0.0f};
    float last_angle_ = 0.0f;
    double turned_ = 0.0, caught_at_ = 0.0;
};

}  // namespace tendril::app
