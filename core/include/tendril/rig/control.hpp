// Controls: elements that a person drags, and what dragging may do.
//
//     kind         value       what it moves
//     Transform    transform   its pose, within its parent
//     Position     vector      its translation, within its parent, metres
//     Rotation     rotation    its rotation, within its parent
//     Float        number      nothing; units read it
//     Bool         bool        nothing; units read it
//     Vector2d     vector      from its pose at rest along two of its axes; the third part is 0
//
// A value starts where the control is at rest: its initial pose, 0, or false. Minimum and maximum bound every
// part of it that is bounded: see Control.
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
/// The type of its value.
Type type_of(ControlKind kind) noexcept;

struct Control {
    ControlKind kind = ControlKind::Transform;
    /// Vector2d only: which of its own axes the two numbers are along, 0 for x, 1 for y, 2 for z; not equal.
    std::array<int, 2> axes{0, 1};
    /// Of each part that the kind has: Float uses x; Vector2d x and y, for the first and the second axis;
    /// Position, and the translation of Transform, all three. Rotation and Bool have none. Each minimum is at
    /// most its maximum.
    std::optional<glm::dvec3> minimum{}, maximum{};

    bool operator==(const Control&) const = default;
};

/// Refused: axes that are not two of three, ends that are not finite or over max_magnitude, a minimum over
/// its maximum. `what` begins the message.
Result check(const char* what, const Control& control) noexcept;

/// What a control at rest has for a value.
Value rest_value(const Control& control, const Transform& initial) noexcept;

/// Brings every part that is out of its range to the end of it. `value` has the type of the kind.
Value clamped(const Control& control, const Value& value) noexcept;

/// The pose, within its parent, of a control with this value. `base` is its pose at rest: it has whatever the
/// value does not say, and the frame in which a Vector2d moves.
Transform posed(const Control& control, const Transform& base, const Value& value) noexcept;

/// A type that the kind does not have, a number that is not finite or over max_magnitude, a rotation of no
/// length, a scale of 0: refused, with `what` in front.
Result check_value(const char* what, const Control& control, const Value& value) noexcept;

}  // namespace tendril::rig
