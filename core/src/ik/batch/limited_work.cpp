// The part of work.cpp for chains within limits.
#include "ik/batch/work.hpp"
#include "ik/limits/pose.hpp"
#include "ik/solve/loop.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {

LimitedJob Work::limited_job(Scratch& scratch) const noexcept {
    return {in_.limits->prepared, in_.options.max_iterations, scratch.tile.block,
            scratch.poses.get(),  scratch.rotations.get(),    scratch.limited.get()};
}

void Work::solve_limited_block(const Block& block, std::size_t index, std::size_t lanes,
                               Scratch& scratch) noexcept {
    const std::size_t first = index * block_lanes;
    Tile& tile = scratch.tile;
    in_.unit.classify_limited(block, lanes);
    const bool vectors = !in_.limits->prepared.empty() && !in_.options.every_iteration;
    LaneList leftover;
    if (vectors) {
        run_limited_tile(block_lanes - max_leftover, scratch);
        leftover = in_.unit.solve_limited(block, lanes, rotations(index), tile.used, limited_job(scratch));
    }
    for (const std::size_t lane : leftover.span()) {
        tile.chains[tile.used++] = static_cast<std::uint32_t>(first + lane);
    }
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Class found = block.class_of(lane);
        if (found == Class::Scalar || (found == Class::Reachable && !vectors)) {
            solve_scalar_limited(block, lane, first + lane, scratch);
        } else if (block.activity(lane) == Activity::Done) {
            report(block, lane, first + lane);
        }
    }
    if (in_.joints != nullptr) return_joints(block, index, lanes);
}

/// Same as Solver::solve with these limits, from the chain's joints and rotations.
void Work::solve_scalar_limited(const Block& block, std::size_t lane, std::size_t chain,
                                Scratch& scratch) noexcept {
    Workspace& scalar = scratch.scalar;
    float* const rows = rotations(chain / block_lanes) + chain % block_lanes;
    const auto component = [&](std::size_t i, int k) -> float& {
        return rows[(4 * i + static_cast<std::size_t>(k)) * block_lanes];
    };
    scalar.saved.reset();  // results must not depend on the previous chain
    for (std::size_t i = 0; i < in_.bones; ++i) {
        for (int k = 0; k < 4; ++k) scalar.saved.rotations[i][k] = component(i, k);
        scalar.rest_directions[i] = in_.limits->rest_directions[i];
    }
    Problem problem = load_problem(block, lane, scratch);
    static_cast<void>(load_limits(scalar, problem.options.limits));
    const Report answer = ik::detail::run(Method::Fabrik, problem, Unwatched());
    for (std::size_t i = 0; i < in_.bones; ++i) {
        block.set_point(i + 1, lane, scalar.joints[i + 1]);
        for (int k = 0; k < 4; ++k) component(i, k) = scalar.saved.rotations[i][k];
    }
    report_fallback(chain, answer);
}

/// Steps until at most `most_left` chains are in the tile.
void Work::run_limited_tile(std::size_t most_left, Scratch& scratch) noexcept {
    Tile& tile = scratch.tile;
    const auto done = [&](std::size_t lane) { return tile.block.activity(lane) == Activity::Done; };
    while (tile.used > most_left) {
        in_.unit.step_limited(tile.used, limited_job(scratch));
        for (std::size_t lane = 0; lane < tile.used; ++lane) {
            if (!done(lane)) continue;
            end_limited(lane, scratch);
            // Move the last active chain into the gap.
            while (--tile.used > lane && done(tile.used)) end_limited(tile.used, scratch);
            if (tile.used > lane) move_limited(tile.used, lane, scratch);
        }
    }
}

/// Moves a chain between lanes of the tile.
void Work::move_limited(std::size_t from, std::size_t to, Scratch& scratch) const noexcept {
    Tile& tile = scratch.tile;
    const auto move = [&](float* rows, std::size_t count) { copy_lane(rows + from, rows + to, count); };
    move(tile.block.joint(0), 3);
    move(tile.block.length(0), Block::length_rows(in_.bones));
    move(tile.block.target(), state_rows);
    move(scratch.poses.get(), pose_rows(in_.bones));
    tile.chains[to] = tile.chains[from];
    tile.block.set_activity(from, Activity::Done);
}

/// Writes back a chain of the tile: its result, or the scalar solver's from its original pose.
void Work::end_limited(std::size_t lane, Scratch& scratch) noexcept {
    const Tile& tile = scratch.tile;
    const std::size_t chain = tile.chains[lane];
    if (tile.block.class_of(lane) == Class::Scalar) {
        fetch_joints(tile, lane);
        solve_scalar_limited(tile.block, lane, chain, scratch);
    } else {
        copy_lane(scratch.rotations.get() + lane, rotations(chain / block_lanes) + chain % block_lanes,
                  4 * in_.bones);
        report(tile.block, lane, chain);
    }
    write_back_joints(lane, scratch);
}

}  // namespace tendril::ik::detail
