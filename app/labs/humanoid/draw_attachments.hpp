// The picture of what hangs on a character.
#pragma once

#include "app/labs/humanoid/attachments.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

void draw_attachments(const View& view, DrawList& list, const Attachments& attachments);

}  // namespace tendril::app
