// Time in a scene file: walks, the take, the clip and what a backward solve left of it, the frame rates.
#pragma once

#include "app/document/json_place.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// Into what is saved of the state; what is not there is left out.
void save_time(const RigPart& part, Json& state);
/// Into a part that has its rig and its state.
void load_time(const JsonPlace& state, RigPart& part);

/// Also what --state shows.
Json walks_json(const RigPart& part);
Json rates_json(const RigPart& part);

}  // namespace tendril::app
