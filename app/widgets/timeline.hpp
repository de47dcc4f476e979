// A strip of time with a head that can be dragged.
#pragma once

namespace tendril::app {

/// `tick` of `ticks`, each of `seconds`. True in a frame in which a person moved the head.
bool timeline(const char* id, int& tick, int ticks, double seconds);

}  // namespace tendril::app
