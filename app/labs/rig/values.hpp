// Values of a rig's state and its controls as JSON, and as text for users.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <tendril/rig/rig.hpp>
#include <vector>

#include "app/fields/input_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"

namespace tendril::app {

/// Refuses rotations without unit length, as a rig's own always have. Accepts all other types.
void check_unit(const JsonPlace& place, const rig::Value& value);
/// Reads a value stored in a state, as the rig reached it.
rig::Value read_stored(const JsonPlace& place, rig::Type type);

/// Calls `take` with each index and the member of that name. Refuses other members, which errors call `what`.
void load_named(const JsonPlace& place, const char* what, const std::vector<std::string>& names, auto take) {
    const std::set<std::string_view> known(names.begin(), names.end());
    if (!place.json().is_object()) place.fail("expected an object, found " + json_summary(place.json()));
    for (const auto& [name, value] : place.json().items())
        if (!known.contains(name))
            place.fail("there is no " + std::string(what) + ' ' + json_summary(Json(name)));
    for (std::size_t i = 0; i < names.size(); ++i) take(i, place[names[i].c_str()]);
}

/// The value in the form of that kind of control: a vector2d is [a, b].
Json control_value_json(rig::ControlKind kind, const rig::Value& value);
/// Members omitted from a transform are taken from `now`.
rig::Value read_control_value(const JsonPlace& place, rig::ControlKind kind, const rig::Value& now,
                              double most = most_given);
/// The values of a rig's controls by name; `controls` has one for each element.
Json controls_json(const rig::Rig& rig, const std::vector<rig::Value>& controls);
void load_controls(const JsonPlace& place, const rig::Rig& rig, std::vector<rig::Value>& controls);
/// Reads the value of one control, within its limits.
rig::Value read_reached(const JsonPlace& place, const rig::Control& control, const rig::Value& now);

// When several values are set at once, each keeps its untouched parts: null in a vector, omitted from a
// transform.
// / `after` without the members that equal those of `before`.
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
