// A clip in a scene file, and what a backward solve left of it:
//
//     {"began": 0, "frames": 121, "bones": {"skull": {"translation": [...], "rotation": [...]}, ...},
//      "solve": {"running": false, "left": [[mm, degrees, bone], ...], "controls": {...}}}
//
// Of a bone each of translation, rotation and scale is there once, where it never changes, or frame after
// frame in one list; a scale of 1 is left out.
#pragma once

#include "app/document/json_place.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

Json clip_json(const RigPart& part);  ///< that has one
void load_clip(const JsonPlace& place, RigPart& part);

}  // namespace tendril::app
