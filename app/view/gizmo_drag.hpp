// Dragging one part of a gizmo: from lines of sight to frames. No window and no drawing in it.
//
// All is measured in the plane through the middle that faces the eye, where a line of sight always meets
// something near. From there an arrow's axis and a plane are found as perspective has them, so what was
// caught stays under the pointer; but where an axis points at the eye, a plane is seen edge on, or the
// pointer nears the horizon of one, where a pixel would mean kilometres, it goes on evenly instead. So a
// small move of the pointer is a small move of the frame, from everywhere.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "app/view/gizmo.hpp"

namespace tendril::app {

class GizmoDrag {
  public:
    /// `caught`: the line of sight where the part was caught. `reach`: metres from the middle to the ring or
    /// the box; to drag as far again doubles a scale. `orthographic`: lines of sight are parallel.
    GizmoDrag(GizmoPart part, const HandleFrame& frame, const Ray& caught, float reach, bool orthographic);

    /// The frame for a line of sight. A ring counts its turns from call to call, half a turn at most between
    /// two. Where the line of sight says nothing (it is not finite, or looks away), the last frame.
    HandleFrame to(const Ray& ray);

    /// `now` with what the part changes as `dragged` has it: its rotation, its scale along the axis,
    /// its place along the arrow or in the plane.
    HandleFrame changed(const HandleFrame& now, const HandleFrame& dragged) const;

    GizmoPart part() const { return part_; }
    const HandleFrame& from() const { return from_; }
    /// Of a ring: radians since it was caught, whole turns too.
    double turned() const { return turned_; }
    /// Of a ring: where it was caught, radians about its axis.
    double caught_at() const { return caught_at_; }
    /// What came of it, once the frame is `now`: "35.2° about X", "0.25 m along X", "1.50 times along X".
    std::string text(const HandleFrame& now) const;

  private:
    std::optional<glm::vec3> facing(const Ray& ray) const;
    glm::vec2 measured(glm::vec3 at) const;
    float along_axis(glm::vec3 at, glm::vec3 axis) const;
    glm::vec2 in_plane(glm::vec3 at) const;
    float about_axis(glm::vec3 at) const;

    GizmoPart part_;
    HandleFrame from_, last_;
    glm::vec3 axis_, u_, v_;  ///< of the part: along, about or upright; the two others
    glm::vec3 sight_;         ///< unit, from the eye to the middle
    float distance_ = 1.0f;   ///< from the eye to the middle
    float nearness_ = 0.0f;   ///< its inverse; 0 where lines of sight are parallel
    float reach_;
    bool edge_on_ = false;  ///< a ring of which one sees hardly more than a line
    glm::vec2 caught_{0.0f};
    float last_angle_ = 0.0f;
    double turned_ = 0.0, caught_at_ = 0.0;
};

}  // namespace tendril::app
