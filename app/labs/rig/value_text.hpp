// Values of rigs as people read them: metres, degrees, on and off.
#pragma once

#include <string>
#include <tendril/rig/control.hpp>
#include <tendril/rig/unit.hpp>

namespace tendril::app {

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
