// Rows of the Linkage lab's panel and inspector.
#pragma once

#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {

/// What the linkage does, or what to do next.
Verdict linkage_verdict(const LinkagePart& part);

}  // namespace tendril::app
