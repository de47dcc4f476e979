// Values as units pass them on, whatever their type. Not installed.
#pragma once

#include "tendril/rig/input.hpp"

namespace tendril::rig {

/// False, 0, a vector of 0, no rotation, the identity.
Value neutral(Type type) noexcept;

/// Finite, at most max_magnitude in magnitude, rotations of some length, scales not 0. `what` begins the
/// message.
Result check(const char* what, const Value& value) noexcept;

/// With rotations of unit length.
Value normalised(const Value& value) noexcept;

/// Whether a unit may pass it on.
bool is_fine(const Value& value) noexcept;

}  // namespace tendril::rig
