// The strip of the last ten seconds below the scene, with a mark for all that happened in them.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "app/document/workspace.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// `can_record`: with a button to make a video of them, which shows nothing but the view of the scene.
void past_strip(const Workspace& workspace, Emit& emit, bool can_record = true);

/// "Joint 2 flipped: its bone turned 128 degrees in one tick"
std::string incident_title(const Incident& incident);
glm::vec3 incident_colour(const Incident& incident, const Palette& palette);

}  // namespace tendril::app
