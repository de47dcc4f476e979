// What a unit remembers of an element, as JSON: null where it is nothing, else an object with one member that
// says what it is, {"turned"}, {"output"}, {"spring"} or {"ik"}.
#pragma once

#include <tendril/rig/rig.hpp>

#include "app/document/json.hpp"
#include "app/document/json_place.hpp"

namespace tendril::app {

Json memory_json(const rig::UnitMemory& memory);
rig::UnitMemory read_memory(const JsonPlace& place);

}  // namespace tendril::app
