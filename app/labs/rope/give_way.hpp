// What is dragged while time stands.
#pragma once

#include <functional>

#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

/// Pins and colliders go where `send` sends them, in the seconds that it is told, and ropes, cloth and hair
/// give way as far as they are pulled or pushed; all else stays as it is. No time passes: what moved goes on,
/// once time does, as fast as it was; what was on its way still is. Nothing tears.
void give_way(RopePart& part, rope::World& world,
              const std::function<void(rope::World& world, double seconds)>& send);

}  // namespace tendril::app
