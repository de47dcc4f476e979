// The mark beside a title that shows whether what it heads is folded.
#pragma once

#include <imgui.h>

namespace tendril::app {

/// Points down if open, else right; centred at `at`, for the current text size.
void fold_mark(ImVec2 at, bool open, ImU32 colour);

}  // namespace tendril::app
