// The state of a rig as a scene file has it: {"controls", "curves", "poses", "units"}. It comes back to the
// bit.
#pragma once

#include <tendril/rig/rig.hpp>

#include "app/document/json.hpp"
#include "app/document/json_place.hpp"

namespace tendril::app {

Json rig_state_json(const rig::Rig& rig, const rig::State& state);
/// Other members are for others to read. Throws std::runtime_error that begins with the place.
rig::State read_rig_state(const JsonPlace& place, const rig::Rig& rig);

// What a unit remembers of an element, as JSON: null where it is nothing, else an object with one member that
// says what it is, {"turned"}, {"output"}, {"spring"} or {"ik"}.

Json memory_json(const rig::UnitMemory& memory);
rig::UnitMemory read_memory(const JsonPlace& place);

}  // namespace tendril::app
