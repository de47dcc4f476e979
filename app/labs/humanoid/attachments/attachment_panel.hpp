// Attachments in the panel and in the view.
#pragma once

#include "app/labs/humanoid/attachments/attachments.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

/// The colour of attached ropes and cloth.
glm::vec3 attached_colour(const Palette& palette);
void draw_attachments(const View& view, DrawList& list, const Attachments& attachments);

}  // namespace tendril::app
