// The rig as a C++ program against the library.
#pragma once

#include <string>
#include <tendril/rig/rig.hpp>

#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// A whole program: makes the rig, sets it as it is set here, solves, and prints every element's global pose,
/// the same as here.
std::string rig_code(const RigPart& part);

// Units of a rig, and what they remember, as C++ has them.

/// "glm::dquat(w, x, y, z)"; "rig::Transform{...}", without what is as it is by itself.
std::string rotation_code(const glm::dquat& rotation);
std::string transform_code(const rig::Transform& transform);
/// "rig::Value(0.5)"
std::string value_code(const rig::Value& value);

/// "rig::Unit{.name = "aim", .operation = rig::Aim{...}, ...}": inputs that differ from the default, each on
/// a line of its own below `margin`.
std::string unit_code(const rig::Unit& unit, const std::string& margin);

/// Statements that make `place` the memory; empty where there is none.
std::string memory_code(const std::string& place, const rig::UnitMemory& memory);

}  // namespace tendril::app
