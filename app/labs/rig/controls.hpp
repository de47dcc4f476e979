// Where a control is drawn and how a drag of it becomes a value: the rail of a float, the rectangle of a
// vector2d, the box of what has a place. Poses are double here, and become float in the picture.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <tendril/rig/control.hpp>
#include <tendril/rig/hierarchy.hpp>

#include "app/document/json.hpp"
#include "app/labs/lab.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// A float's rail: as long whatever its range; without a limit it goes on.
struct Rail {
    static constexpr double length = 0.8;  ///< metres
    double low = -1.0, high = 1.0;         ///< values at its ends
    bool open_low = true, open_high = true;

    double place(double value) const;  ///< metres from its middle
    double value(double place) const;
};
Rail rail_of(const rig::Control& control);

/// One control of a rig as it is now; the rig and the hierarchy, in which nothing is pending, must outlive
/// it.
class ControlShape {
  public:
    /// Nothing where the element is no control.
    static std::optional<ControlShape> of(const RigPart& part, const rig::Hierarchy& elements,
                                          std::size_t element);

    rig::ControlKind kind() const { return control_.kind; }
    const rig::Control& control() const { return control_; }
    const rig::Value& value() const { return value_; }
    double number() const { return std::get<double>(value_); }
    bool on() const { return std::get<bool>(value_); }

    /// Global: of the control, or of the knob that moves along its rail.
    rig::Transform pose() const;
    /// Global, of a point that a value has: in the parent for a place, along the two axes for a vector2d.
    glm::dvec3 placed(const glm::dvec3& value) const;
    /// Global, of the rail's middle; along its x.
    const rig::Transform& rail_pose() const { return now_; }

    /// Whether a part of its value is at the end of its range. At the value that a control begins with that
    /// is how it is made, and says nothing.
    bool at_limit() const;
    bool can_be_dragged() const;
    Drag drag() const;
    /// The part of a gizmo that dragging its knob is.
    std::optional<GizmoPart> part() const;
    /// The value that brings it to a frame, of which only what differs from `from` is taken.
    Json value_at(const HandleFrame& from, const HandleFrame& to) const;
    /// "0.50", "0.25, -0.10", "on"; empty for what is seen as it is.
    std::string text() const;

  private:
    ControlShape(const rig::Control& control, const rig::Value& value, const rig::Transform& initial)
        : control_(control), value_(value), initial_(initial) {}
    bool ends_at(std::size_t part, double value) const;

    const rig::Control& control_;
    const rig::Value& value_;
    const rig::Transform& initial_;
    rig::Transform space_;  ///< of its parent, global
    rig::Transform rest_;   ///< its input pose, local
    rig::Transform now_;    ///< global
};

HandleFrame frame_of(const rig::Transform& pose);
rig::Transform transform_of(const HandleFrame& frame);
/// Of a transform those members, as JSON, in which `to` differs from `from`.
Json changed_transform(const rig::Transform& transform, const HandleFrame& from, const HandleFrame& to);

}  // namespace tendril::app
