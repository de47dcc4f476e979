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

// A clip in a scene file, and what a backward solve left of it:
//
//     {"began": 0, "frames": 121, "bones": {"skull": {"translation": [...], "rotation": [...]}, ...},
//      "solve": {"running": false, "left": [[mm, degrees, bone], ...], "controls": {...}}}
//
// Of a bone each of translation, rotation and scale is there once, where it never changes, or frame after
// frame in one list; a scale of 1 is left out.

Json clip_json(const RigPart& part);  ///< that has one
void load_clip(const JsonPlace& place, RigPart& part);

}  // namespace tendril::app
