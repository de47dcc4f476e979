// The stretch of time that the Rig lab is in: a take. It begins with a state, and what comes after follows
// from that alone, from the paths that controls follow and from what was set of controls since, and where the
// rig was solved then. So any tick of it can be worked out anew, in any order, to the bit.
//
// A tick is tick_seconds long whatever the speed of the clock, which says how many of them pass: slow motion
// shows the very poses that real time shows.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <tendril/rig/rig.hpp>
#include <vector>

#include "app/labs/kit/motion.hpp"

namespace tendril::app {

/// Ten minutes. One that grows longer goes on as another.
inline constexpr std::uint32_t max_take_ticks = 36'000;
/// Likewise.
inline constexpr std::size_t max_take_keys = 3'600;

/// A control follows a path, which lies flat within the control's space: its y stays.
struct RigWalk {
    std::string control;  ///< a transform or position control
    Motion motion;        ///< `ticks`: how far round it is where the take begins
    bool turn = false;    ///< a transform control looks along the path, with its z axis
    bool operator==(const RigWalk&) const = default;
};

/// What was done after a tick, before the next: a control was set; or the rig was solved without any time
/// passing, as every drag does while the simulation is paused.
struct TakeKey {
    static constexpr std::uint32_t solve = ~0u;
    std::uint32_t tick = 0;
    std::uint32_t element = 0;  ///< its place in the definition, or solve
    rig::Value value{};         ///< within its limits
    bool operator==(const TakeKey&) const = default;
};

struct RigTake {
    std::shared_ptr<const rig::State> start;           ///< null until a tick has passed
    std::shared_ptr<const std::vector<TakeKey>> keys;  ///< by tick, in order; null where there are none
    std::uint32_t tick = 0;                            ///< that it is at
    std::uint32_t last = 0;                            ///< that it was played to
    std::uint64_t began = 0;                           ///< the tick of the lab's time where it begins

    std::uint64_t now() const { return began + tick; }
    bool operator==(const RigTake& other) const;
};

}  // namespace tendril::app
