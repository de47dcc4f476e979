// The drawing of controls, and values from drags: the rail of a float, the rectangle of a vector2d, the box
// of a control with a position. Poses here are double; drawing converts them to float.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <tendril/rig/control.hpp>
#include <tendril/rig/hierarchy.hpp>

#include "app/io/json.hpp"
#include "app/labs/lab.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// The rail of a float control. Its length does not depend on the range; an end without a limit is open.
struct Rail {
    static constexpr double length = 0.8;  ///< metres
    double low = -1.0, high = 1.0;         ///< values at its ends
    bool open_low = true, open_high = true;

    double place(double value) const;  ///< metres from the middle of the rail
    double value(double place) const;
};
Rail rail_of(const rig::Control& control);

/// The shape of one control. The rig and the hierarchy, with nothing pending, must outlive it.
class ControlShape {
  public:
    /// Empty if the element is not a control.
    static std::optional<ControlShape> of(const RigPart& part, const rig::Hierarchy& elements,
                                          std::size_t element);

    rig::ControlKind kind() const { return control_.kind; }
    const rig::Control& control() const { return control_; }
    const rig::Value& value() const { return value_; }
    double number() const { return std::get<double>(value_); }
    bool on() const { return std::get<bool>(value_); }

    /// Global pose of the control, or of the knob on its rail.
    rig::Transform pose() const;
    /// Global position of a value: in the parent's space, or along the two axes of a vector2d.
    glm::dvec3 placed(const glm::dvec3& value) const;
    /// Global pose of the middle of the rail, which lies along x.
    const rig::Transform& rail_pose() const { return now_; }

    /// True if a component of the value is at the end of its range, other than by its initial value.
    bool at_limit() const;
    Drag drag() const;
    /// The gizmo part that acts like a drag of the knob.
    std::optional<GizmoPart> part() const;
    /// The value that moves the control to `to`. Ignores members that equal those of `from`.
    Json value_at(const HandleFrame& from, const HandleFrame& to) const;
    /// "0.50", "0.25, -0.10", "on"; empty if the drawing already shows the value.
    std::string text() const;

  private:
    ControlShape(const rig::Control& control, const rig::Value& value, const rig::Transform& initial)
        : control_(control), value_(value), initial_(initial) {}
    bool ends_at(std::size_t part, double value) const;

    const rig::Control& control_;
    const rig::Value& value_;
    const rig::Transform& initial_;
    rig::Transform space_;  ///< the parent's, global
    rig::Transform rest_;   ///< input pose, local
    rig::Transform now_;    ///< global
};

HandleFrame frame_of(const rig::Transform& pose);
rig::Transform transform_of(const HandleFrame& frame);
/// The members of `transform` in which `to` differs from `from`, as JSON.
Json changed_transform(const rig::Transform& transform, const HandleFrame& from, const HandleFrame& to);

}  // namespace tendril::app
