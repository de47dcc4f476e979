// The state of a rig in a scene file: {"controls", "curves", "poses", "units"}. Round trips bit for bit. Also
// the Rig lab's --state.
#pragma once

#include <tendril/rig/rig.hpp>

#include "app/io/json.hpp"
#include "app/io/json_place.hpp"

namespace tendril::app {

Json rig_state_json(const rig::Rig& rig, const rig::State& state);
/// Ignores other members. Throws std::runtime_error that begins with the JSON path.
rig::State read_rig_state(const JsonPlace& place, const rig::Rig& rig);

// A unit's memory of an element, as JSON: null for none, else an object whose only member names the kind of
// memory: {"turned"}, {"output"}, {"spring"} or {"ik"}.

Json memory_json(const rig::UnitMemory& memory);
rig::UnitMemory read_memory(const JsonPlace& place);

}  // namespace tendril::app
