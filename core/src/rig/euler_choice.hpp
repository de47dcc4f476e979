// Euler angles of two rotations, mixed axis by axis. Not installed.
#pragma once

#include <array>

#include "tendril/quat.hpp"

namespace tendril::rig::detail {

/// The rotation that has `to`'s Euler angles (euler.hpp) on the chosen axes and `from`'s on the others.
/// Equals from_euler() of the mixed to_euler() angles, to rounding, at a third of the cost.
glm::dquat choose_angles(const glm::dquat& from, const glm::dquat& to,
                         const std::array<bool, 3>& chosen) noexcept;

}  // namespace tendril::rig::detail
