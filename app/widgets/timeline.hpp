// A strip of time with a head that can be dragged.
#pragma once

#include <vector>

namespace tendril::app {

/// `tick` of `ticks`, each of `seconds`; up to `known` there is something to see. True in a frame in which a
/// person moved the head.
bool timeline(const char* id, int& tick, int ticks, double seconds, int known = 0);

/// The steps of a solve: `ends[i]` is the last step of iteration i (of what comes before the first for i =
/// 0). `step` is 0 to the last of them. True in a frame in which a person moved the head.
bool step_timeline(const char* id, int& step, const std::vector<int>& ends);

}  // namespace tendril::app
