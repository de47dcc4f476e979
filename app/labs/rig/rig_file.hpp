// The Rig lab's time in a scene file: walks, the take, the clip with its backward solve, the frame rates.
#pragma once

#include "app/io/json_place.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// Adds to the saved state. Omits missing data.
void save_time(const RigPart& part, Json& state);
/// `part` must already have its rig and its state.
void load_time(const JsonPlace& state, RigPart& part);

Json walks_json(const RigPart& part);  ///< --state shows it too

// A clip in a scene file, with the result of its backward solve:
//
//     {"began": 0, "frames": 121, "bones": {"skull": {"translation": [...], "rotation": [...]}, ...},
//      "solve": {"running": false, "left": [[mm, degrees, bone], ...], "controls": {...}}}
//
// Translation, rotation and scale of a bone are each stored once if constant, else as one list of all frames.
// A scale of 1 is omitted.

Json clip_json(const RigPart& part);  ///< the part must have a clip
void load_clip(const JsonPlace& place, RigPart& part);

}  // namespace tendril::app
