// The rig as a C++ program that uses the library.
#pragma once

#include <string>
#include <tendril/rig/rig.hpp>

#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// A whole program: builds the rig, sets its inputs, solves, and prints every global pose, the same as here.
std::string rig_code(const RigPart& part);

// Units and their memory as C++ source.

/// "rig::Unit{.name = "aim", .operation = rig::Aim{...}, ...}". Lists only inputs that differ from their
/// default, one per line, indented by `margin`.
std::string unit_code(const rig::Unit& unit, const std::string& margin);

/// Statements that assign the memory to `place`; empty if there is none.
std::string memory_code(const std::string& place, const rig::UnitMemory& memory);

}  // namespace tendril::app
