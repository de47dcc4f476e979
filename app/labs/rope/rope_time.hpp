// How time passes in the Rope lab: whole ticks, or uneven frames by frame-time jitter; colliders that swing.
#pragma once

#include <cstdint>

#include "app/document/runtime.hpp"
#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

/// What worlds are advanced and dragged with, kept from tick to tick.
struct RopeRuntime final : Runtime {
    RopeRuntime();
    rope::Workspace workspace;  ///< with threads where the machine has them
};

/// Lets `seconds` pass in the lab. The world that comes of it does not depend on how they are cut, as long as
/// none are dropped: there are max_lab_work.
/// `workspace` is any, best the same for every tick.
RopeReport pass_time(RopePart& part, double seconds, rope::Workspace& workspace);
/// Of a world's substep, for max_lab_work: counted, not measured, so that every machine drops the same.
std::uint64_t work_of_substep(const NamedWorld& world);

/// Seconds of the jittered frame of that number: a tick at dial 0, anything from 1 to 250 ms at 1.
double jitter_frame(float dial, std::uint32_t number);

/// Where a swinging collider's centre is at a time of the lab.
glm::vec3 swing_point(const Swing& swing, double time);
/// Throws std::invalid_argument where it would swing out of the range of coordinates.
void require(const Swing& swing);

/// Nothing is on its way, and nothing moves faster than one would see.
bool at_rest(const RopePart& part);

/// Whether nothing has reached the edge of the world.
bool in_range(const NamedWorld& world);

}  // namespace tendril::app
