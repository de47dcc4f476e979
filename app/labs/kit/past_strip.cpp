#include "app/labs/kit/past_strip.hpp"

#include <algorithm>

#include "app/widgets/timeline.hpp"

namespace tendril::app {

void past_strip(const Workspace& workspace, Emit& emit) {
    const Rewind& past = workspace.rewind;
    if (past.empty()) return;
    // The strip is ten seconds long from the beginning: what is not there yet is to its right.
    const auto first = past.oldest();
    const int ticks = static_cast<int>(Rewind::most_ticks) + 1;
    const auto last = std::max(past.newest(), workspace.clock.tick);
    const int newest = static_cast<int>(last - first);
    const auto tick_now = std::clamp(workspace.clock.tick, first, last);
    int now = static_cast<int>(tick_now - first);
    if (timeline("past", now, ticks, tick_seconds, newest))
        emit.continuously("time.seek", {{"ticks_back", std::max(0, newest - now)}});
}

}  // namespace tendril::app
