// Advances time in the Rope lab: whole ticks, or uneven frames by frame-time jitter; and swinging colliders.
#pragma once

#include <array>
#include <cstdint>

#include "app/document/runtime.hpp"
#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

/// The workspace for simulating and dragging, kept between ticks.
struct RopeRuntime final : Runtime {
    RopeRuntime();
    rope::Workspace workspace;  ///< multi-threaded if the machine has several cores
    /// The same for each rival of a race, so that each keeps its own preparation.
    std::array<rope::Workspace, 2> of_rivals;
};

/// Advances the lab by `seconds`. The result does not depend on how the time is divided into calls, unless
/// substeps are dropped because of max_lab_work. Any `workspace` works; the same in every tick is fastest.
RopeReport pass_time(RopePart& part, double seconds, rope::Workspace& workspace);
/// The work of a substep, for max_lab_work. Not timed, so that every machine drops the same substeps.
std::uint64_t work_of_substep(const NamedWorld& world);

/// Length in seconds of the frame of that number: even at dial 0, anything from 1 to 250 ms at 1.
double jitter_frame(const Jitter& jitter, std::uint32_t number);

/// Centre of a swinging collider at a simulated time.
glm::vec3 swing_point(const Swing& swing, double time);
/// Throws std::invalid_argument if the swing leaves the range of coordinates.
void require(const Swing& swing);

/// Whether no pin or collider is moving, and no particle moves visibly.
bool at_rest(const RopePart& part);

/// Whether everything is within the bounds of the world.
bool in_range(const NamedWorld& world);

}  // namespace tendril::app
