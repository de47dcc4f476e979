// Controls: elements that a user drags, and the limits of dragging.
//
//     kind         value       effect
//     Transform    transform   its pose, within its parent
//     Position     vector      its translation, within its parent, metres
//     Rotation     rotation    its rotation, within its parent
//     Float        number      nothing; units read it
//     Bool         bool        nothing; units read it
//     Vector2d     vector      offset from its rest pose along two of its axes; the third part is 0
//
// A value starts at rest: the control's initial pose, 0, or false. Minimum and maximum bound its components,
// see Control.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "tendril/result.hpp"
#include "tendril/rig/input.hpp"

namespace tendril::rig {

enum class ControlKind : std::uint8_t { Transform, Position, Rotation, Float, Bool, Vector2d };
/// "vector2d"
const char* name(ControlKind kind) noexcept;
/// The type of a control's value.
Type type_of(ControlKind kind) noexcept;

struct Control {
    ControlKind kind = ControlKind::Transform;
    /// Vector2d only: the axes of its two numbers, 0 for x, 1 for y, 2 for z; not equal.
    std::array<int, 2> axes{0, 1};
    /// Per component: Float uses x; Vector2d x and y, for the first and the second axis; Position, and the
    /// translation of Transform, all three. Rotation and Bool have none. Each minimum is at most its maximum.
    std::optional<glm::dvec3> minimum{}, maximum{};

    bool operator==(const Control&) const = default;
};

/// Refuses axes that are equal or not 0 to 2, bounds that are not finite or over max_magnitude, and a minimum
/// over its maximum. `what` begins the message.
Result check(const char* what, const Control& control) noexcept;

/// The value of a control at rest.
Value rest_value(const Control& control, const Transform& initial) noexcept;

/// Clamps every bounded component. `value` must have the kind's type.
Value clamped(const Control& control, const Value& value) noexcept;

/// The pose within its parent of a control with this value. `base`, its pose at rest, gives the parts that
/// the value lacks, and the frame in which a Vector2d moves.
Transform posed(const Control& control, const Transform& base, const Value& value) noexcept;

/// Refuses a value of another type, a number that is not finite or over max_magnitude, a rotation of length
/// 0, and a scale of 0. `what` begins the message.
Result check_value(const char* what, const Control& control, const Value& value) noexcept;

}  // namespace tendril::rig
