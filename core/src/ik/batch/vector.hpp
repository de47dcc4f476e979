// What solve_many does with vector registers, compiled once for each vector unit. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "ik/batch/block.hpp"
#include "ik/batch/limits.hpp"
#include "ik/tunables.hpp"
#include "tendril/ik/many.hpp"

namespace tendril::ik::detail {

/// What the accelerated step works with.
struct StepScratch {
    float* shapes;   ///< shape_floats of it
    Block gathered;  ///< chains of a block that take the step, side by side
    Block second;    ///< those of them that try the second family of shapes
};
/// The bones of two shapes of one register of chains.
inline std::size_t shape_floats(std::size_t bones) noexcept {
    return 2 * 3 * bones * 16;
}

struct Order {
    int iterations;      ///< at most so many now
    int max_iterations;  ///< and so many in all, counted in Row::Iterations
    bool every;          ///< whether chains go on that have arrived
    StepScratch step;
};

/// Rows of what a pose consists of: how each bone is turned against its parent, and which limits it stands
/// at.
inline std::size_t pose_rows(std::size_t bones) noexcept {
    return (4 + 3 + 2) * bones;
}
/// And of what follows from that: the joints, and how each bone is turned in the world.
inline std::size_t full_pose_rows(std::size_t bones) noexcept {
    return pose_rows(bones) + 3 * (bones + 1) + 4 * bones;
}
/// For chains within limits.
struct LimitedOrder {
    std::span<const BatchLimit> limits;  ///< one a bone
    int max_iterations;
    Block tile;        ///< of the chains that take long; but for the root its joints are written only
    float* poses;      ///< of the tile: pose_rows
    float* rotations;  ///< of the tile, as SolveLimited has them; written only
    float* scratch;    ///< limited_floats of it
};

/// So few chains of a register of `width` are left to the tile.
inline constexpr std::size_t late_lanes(std::size_t width) noexcept {
    return static_cast<std::size_t>(static_cast<double>(width) * tune::batch::register_part);
}
inline constexpr std::size_t most_late = late_lanes(block_lanes);

/// Two poses of one register of chains, and what a step needs of each bone.
inline std::size_t limited_floats(std::size_t bones) noexcept {
    return (2 * full_pose_rows(bones) + (3 + 3 + 3 + 3 + 2) * bones) * 16;
}

/// How many chains still iterate, and whether any of them waits for a perturbation first.
struct Left {
    std::size_t active = 0;
    bool perturb = false;
};

// All work on the first `lanes` lanes and what is left of the last register beyond them.

/// Reads joints, lengths and targets; brings what is loose to its lengths, what is out of reach straight and
/// what is too close folded; writes the state from Row::Residual on.
using Classify = Left(const Block& block, std::size_t lanes, bool every);
/// The same for chains within limits: what is not surely reachable goes to the scalar solver as it is.
using ClassifyLimited = void(const Block& block, std::size_t lanes);
/// Solves those that are reachable, from their joints and four rows of rotations a bone, in the order of
/// glm::quat. What does not arrive stays as it was and goes to the scalar solver; but the last of a register
/// are moved to the tile, from lane `used` on. Returns which, at most most_late of a block.
using SolveLimited = LaneList(const Block& block, std::size_t lanes, float* rotations, std::size_t used,
                              const LimitedOrder& order);
/// Some steps of the tile's first `used` lanes. As above, but without the tile.
using StepLimited = void(std::size_t used, const LimitedOrder& order);
/// Iterates the active lanes until they are done, wait for a perturbation or the order's iterations are used
/// up.
using Iterate = Left(const Block& block, std::size_t lanes, const Order& order);
/// Targets and tolerances of the first `lanes` lanes; a negative tolerance stands for 1e-3 of the reach.
using SetTargets = void(const Block& block, std::size_t lanes, const glm::vec3* targets, float tolerance);
/// Between lists of `count` floats, one chain's after the other's, and as many rows of a block.
using CopyIn = void(const float* lists, std::size_t lanes, std::size_t count, float* rows);
using CopyOut = void(const float* rows, std::size_t lanes, std::size_t count, float* lists);
/// Whether all coordinates are finite and at most max_magnitude.
using AreValid = bool(const float* coordinates, std::size_t count);

struct VectorUnit {
    Classify* classify = nullptr;
    Iterate* iterate = nullptr;
    ClassifyLimited* classify_limited = nullptr;
    SolveLimited* solve_limited = nullptr;
    StepLimited* step_limited = nullptr;
    SetTargets* set_targets = nullptr;
    CopyIn* copy_in = nullptr;
    CopyOut* copy_out = nullptr;
    AreValid* are_valid = nullptr;
};

/// As compiled for one of Highway's targets.
Classify* classify_with(std::int64_t target) noexcept;
Iterate* iterate_with(std::int64_t target) noexcept;
ClassifyLimited* classify_limited_with(std::int64_t target) noexcept;
SolveLimited* solve_limited_with(std::int64_t target) noexcept;
StepLimited* step_limited_with(std::int64_t target) noexcept;
/// Fills in the other four.
void transfers_with(std::int64_t target, VectorUnit& unit) noexcept;

/// Null for a name that is not among vector_units().
const VectorUnit* vector_unit_named(std::string_view name) noexcept;

}  // namespace tendril::ik::detail
