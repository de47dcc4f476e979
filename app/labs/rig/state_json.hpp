// The state of a rig as a scene file has it: {"controls", "curves", "poses", "units"}. It comes back to the
// bit.
#pragma once

#include <tendril/rig/rig.hpp>

#include "app/document/json_place.hpp"

namespace tendril::app {

Json rig_state_json(const rig::Rig& rig, const rig::State& state);
/// Other members are for others to read. Throws std::runtime_error that begins with the place.
rig::State read_rig_state(const JsonPlace& place, const rig::Rig& rig);

}  // namespace tendril::app
