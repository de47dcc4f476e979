// Values passed between units, of any type. Not installed.
#pragma once

#include "tendril/rig/input.hpp"

namespace tendril::rig {

/// The neutral value: false, 0, the zero vector, the identity.
Value neutral(Type type) noexcept;

/// Refuses numbers that are not finite or over max_magnitude, rotations of length 0, scales of 0. `what`
/// begins the message.
Result check(const char* what, const Value& value) noexcept;

/// The value with its rotations normalised.
Value normalised(const Value& value) noexcept;

/// Whether a unit may output the value: finite and within max_magnitude.
bool is_in_range(const Value& value) noexcept;

}  // namespace tendril::rig
