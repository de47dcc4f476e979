// The picture of what hangs on a character.
#pragma once

#include "app/labs/humanoid/attachments/attachments.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

/// Of ropes and cloth that hang on a character.
glm::vec3 attached_colour(const Palette& palette);
void draw_attachments(const View& view, DrawList& list, const Attachments& attachments);

}  // namespace tendril::app
