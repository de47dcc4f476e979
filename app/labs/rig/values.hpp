// Values of a rig's state and its controls as JSON, and as text for users.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <tendril/rig/control.hpp>
#include <tendril/rig/input.hpp>
#include <tendril/rig/unit.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/document/json_place.hpp"
#include "app/fields/input_json.hpp"

namespace tendril::app {

/// Refuses rotations that are not of unit length, as a rig's own always are. Accepts all other types.
void check_unit(const JsonPlace& place, const rig::Value& value);
/// Reads a value that a rig reached, as it was stored.
rig::Value read_stored(const JsonPlace& place, rig::Type type);

/// The value in the form of that kind of control: a vector2d is [a, b].
Json control_value_json(rig::ControlKind kind, const rig::Value& value);
/// Members omitted from a transform are taken from `now`.
rig::Value read_control_value(const JsonPlace& place, rig::ControlKind kind, const rig::Value& now,
                              double most = most_given);

// When several values are set at once, each keeps its untouched parts: null in a vector, omitted from a
// transform.
/// `after` without the members that equal `before`.
Json touched(Json after, const Json& before);
/// `given`, with nulls replaced from `now`. A rotation is given whole or not at all.
Json filled(Json given, const Json& now);

// Rig values as text for users: metres, degrees, on and off.

/// "0.00  1.20  -0.45"
std::string vector_text(const glm::dvec3& vector, int decimals = 2);
/// Euler angles in the order XYZ, degrees: "10.0  -90.0  0.0"
std::string rotation_text(const glm::dquat& rotation);
/// The value on one line. A transform shows its translation, and its rotation if it has one.
std::string value_text(const rig::Value& value);
/// An output of a unit; the count of a for-each has no decimals.
std::string output_text(const rig::Operation& operation, const rig::Value& value);
/// "2D control", "float control"
const char* control_title(rig::ControlKind kind);

/// Euler angles in the order XYZ, degrees; no -0.
glm::dvec3 euler_degrees(const glm::dquat& rotation);
glm::dquat from_euler_degrees(const glm::dvec3& degrees);

}  // namespace tendril::app
