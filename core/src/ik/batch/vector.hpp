// The parts of solve_many that use vector registers, compiled once per vector unit. Not installed.
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

/// Scratch memory of the accelerated step.
struct StepScratch {
    float* shapes;   ///< shape_floats
    Block gathered;  ///< chains of a block that take the step, side by side
    Block second;    ///< the gathered chains that try the second family of shapes
};
/// Size of the bones of two shapes of one register of chains.
inline std::size_t shape_floats(std::size_t bones) noexcept {
    return 2 * 3 * bones * 16;
}

struct IterateJob {
    int iterations;      ///< maximum in this call
    int max_iterations;  ///< maximum in total, counted in Row::Iterations
    bool every;          ///< converged chains continue
    StepScratch step;
};

/// Rows of a pose's independent data: each bone's rotation relative to its parent, and the limits that it is
/// at.
inline std::size_t pose_rows(std::size_t bones) noexcept {
    return (4 + 3 + 2) * bones;
}
/// Rows of all data, including the dependent: joints and world rotations.
inline std::size_t full_pose_rows(std::size_t bones) noexcept {
    return pose_rows(bones) + 3 * (bones + 1) + 4 * bones;
}
/// For chains within limits.
struct LimitedJob {
    std::span<const BatchLimit> limits;  ///< one per bone
    int max_iterations;
    Block tile;        ///< the chains that take long; only the root of its joints is read
    float* poses;      ///< pose_rows of the tile
    float* rotations;  ///< rotations of the tile, as in SolveLimited; only written
    float* scratch;    ///< limited_floats
};

/// A register of `width` with at most this many active chains moves them to the tile.
inline constexpr std::size_t leftover_lanes(std::size_t width) noexcept {
    return static_cast<std::size_t>(static_cast<double>(width) * tune::batch::register_part);
}
inline constexpr std::size_t max_leftover = leftover_lanes(block_lanes);

/// Size of two poses of one register of chains, plus a step's data per bone.
inline std::size_t limited_floats(std::size_t bones) noexcept {
    return (2 * full_pose_rows(bones) + (3 + 3 + 3 + 3 + 2) * bones) * 16;
}

/// The number of chains that still iterate; `perturb` if any of them waits for a perturbation first.
struct Remaining {
    std::size_t active = 0;
    bool perturb = false;
};

// These functions work on the first `lanes` lanes and the rest of the last register.

/// Reads joints, lengths and targets. Enforces lengths, straightens chains out of reach and folds those too
/// close; writes Row::Class.
using Classify = void(const Block& block, std::size_t lanes);
/// Writes the rest of the state, from Row::Residual on. In a plane, all chains that bend_to_pole may bend
/// become Class::Collinear too.
using Begin = Remaining(const Block& block, std::size_t lanes, bool every, bool planar);
/// Classify for chains within limits: any chain not certainly reachable is left to the scalar solver
/// unchanged.
using ClassifyLimited = void(const Block& block, std::size_t lanes);
/// Solves the reachable chains from their joints and four rows of rotations per bone, in the order of
/// glm::quat. Chains that do not converge are left unchanged for the scalar solver, but the last ones of a
/// register move to the tile, from lane `used` on. Returns those, at most max_leftover per block.
using SolveLimited = LaneList(const Block& block, std::size_t lanes, float* rotations, std::size_t used,
                              const LimitedJob& job);
/// A few steps of the tile's first `used` lanes, without moving chains to the tile.
using StepLimited = void(std::size_t used, const LimitedJob& job);
/// Iterates the active lanes until they are done, wait for a perturbation, or reach the job's iterations.
using Iterate = Remaining(const Block& block, std::size_t lanes, const IterateJob& job);
/// Sets targets and tolerances of the first `lanes` lanes; a negative tolerance means 1e-3 of the reach.
using SetTargets = void(const Block& block, std::size_t lanes, const glm::vec3* targets, float tolerance);
/// Copies between lists of `count` floats, chain after chain, and as many rows of a block.
using CopyIn = void(const float* lists, std::size_t lanes, std::size_t count, float* rows);
using CopyOut = void(const float* rows, std::size_t lanes, std::size_t count, float* lists);
/// True if all coordinates are finite and at most max_magnitude.
using AreValid = bool(const float* coordinates, std::size_t count);

struct VectorUnit {
    Classify* classify = nullptr;
    Begin* begin = nullptr;
    Iterate* iterate = nullptr;
    ClassifyLimited* classify_limited = nullptr;
    SolveLimited* solve_limited = nullptr;
    StepLimited* step_limited = nullptr;
    SetTargets* set_targets = nullptr;
    CopyIn* copy_in = nullptr;
    CopyOut* copy_out = nullptr;
    AreValid* are_valid = nullptr;
};

/// The functions compiled for one of Highway's targets.
Classify* classify_with(std::int64_t target) noexcept;
Begin* begin_with(std::int64_t target) noexcept;
Iterate* iterate_with(std::int64_t target) noexcept;
ClassifyLimited* classify_limited_with(std::int64_t target) noexcept;
SolveLimited* solve_limited_with(std::int64_t target) noexcept;
StepLimited* step_limited_with(std::int64_t target) noexcept;
/// Sets the remaining four.
void transfers_with(std::int64_t target, VectorUnit& unit) noexcept;

/// Null if the name is not in vector_units().
const VectorUnit* vector_unit_named(std::string_view name) noexcept;

}  // namespace tendril::ik::detail
