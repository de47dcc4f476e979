// The values of rigs as JSON, in commands, scene files and --state alike: a bool, a number, [x, y, z],
// [x, y, z, w], {"translation", "rotation", "scale"}. Doubles are written as they are, and read back to the
// bit.
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

namespace tendril::app {

/// Refuses any that is not `known`: "units.2: unknown member "taget"; it takes: item, primary".
void check_members(const JsonPlace& place, const std::vector<std::string>& known);
/// The place in `names` of the text that stands there. Refuses others, and says what there is.
std::size_t read_name(const JsonPlace& place, std::span<const std::string_view> names);
inline std::size_t read_name(const JsonPlace& place, std::initializer_list<std::string_view> names) {
    return read_name(place, std::span(names.begin(), names.size()));
}

/// What a person or a file may give, and what a rig may come to by itself.
inline constexpr double most_given = 1e9, max_reached = 1e100;

// Numbers over `most` in magnitude are refused.
Json rotation_json(const glm::dquat& rotation);
/// Of any length; the library makes it a unit one.
glm::dquat read_rotation(const JsonPlace& place, double most = most_given);

Json transform_json(const rig::Transform& transform);
/// What is left out is as `otherwise` has it.
rig::Transform read_transform(const JsonPlace& place, const rig::Transform& otherwise = {},
                              double most = most_given);

Json value_json(const rig::Value& value);
/// Of that type.
rig::Value read_value(const JsonPlace& place, rig::Type type, double most = most_given);
/// Of the type that its form shows.
rig::Value read_any_value(const JsonPlace& place, double most = most_given);

/// A rotation, of which these only take one of unit length, as a rig holds them. What is none is fine.
void check_unit(const JsonPlace& place, const rig::Value& value);
/// What a rig has come to, as it was stored.
rig::Value read_stored(const JsonPlace& place, rig::Type type);

/// As a control of that kind has it: a vector2d is [a, b].
Json control_value_json(rig::ControlKind kind, const rig::Value& value);
/// A transform's members that are left out stay as `now` has them.
rig::Value read_control_value(const JsonPlace& place, rig::ControlKind kind, const rig::Value& now,
                              double most = most_given);

// Of several things that are set at once each keeps what was not touched: that is null in a vector, or left
// out of a transform.
/// `after` without what is as in `before`.
Json touched(Json after, const Json& before);
/// `given` with what is null as `now` has it. A rotation is whole or not there.
Json filled(Json given, const Json& now);

// Values of rigs as people read them: metres, degrees, on and off.

/// "0.00  1.20  -0.45"
std::string vector_text(const glm::dvec3& vector, int decimals = 2);
/// Euler angles in the order XYZ, degrees: "10.0  -90.0  0.0"
std::string rotation_text(const glm::dquat& rotation);
/// On one line; of a transform the translation, and the rotation where it is turned.
std::string value_text(const rig::Value& value);
/// Of what a unit hands out: a for-each a count, without decimals.
std::string output_text(const rig::Operation& operation, const rig::Value& value);
/// "2D control", "float control"
const char* control_title(rig::ControlKind kind);

/// Euler angles in the order XYZ, degrees; no -0.
glm::dvec3 euler_degrees(const glm::dquat& rotation);
glm::dquat from_euler_degrees(const glm::dvec3& degrees);

}  // namespace tendril::app
