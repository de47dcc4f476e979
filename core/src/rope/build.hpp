// Ropes, sheets and locks as particles and links. Not installed.
#pragma once

#include <string_view>

#include "tendril/rope/world.hpp"

namespace tendril::rope::detail {

// Each appends a body of that name to a state, with pins; the name must be free. Throws std::invalid_argument
// naming what is out of range, before anything is changed.
void build(State& state, const RopeShape& shape, std::string name);
void build(State& state, const SheetShape& shape, std::string name);
void build(State& state, const LockShape& shape, std::string name);

/// Where gravity pulls, a unit vector; down where there is none.
glm::dvec3 down(const Settings& settings) noexcept;
/// Gravity and what there is beside it, m/s^2.
glm::dvec3 acceleration(const Settings& settings) noexcept;

}  // namespace tendril::rope::detail
