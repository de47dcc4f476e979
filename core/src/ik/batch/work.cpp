#include "ik/batch/work.hpp"

#include <algorithm>

#include "ik/solve/loop.hpp"
#include "ik/solve/perturbation.hpp"
#include "ik/solve/prepare.hpp"

namespace tendril::ik::detail {
namespace {

// Chosen by measuring (tests/bench/ik_many.cpp). To move a chain costs as much as some ten iterations of it.
constexpr std::size_t few = block_lanes / 2;    ///< fewer active chains than these leave their block
constexpr int short_burst = 2, long_burst = 4;  ///< iterations between two looks at who is done: in blocks,
                                                ///< and among those that take long

void copy_lane(const Block& from, std::size_t from_lane, const Block& to, std::size_t to_lane,
               std::size_t first_row, std::size_t rows) noexcept {
    const float* source = from.joint(0) + first_row * block_lanes + from_lane;
    float* out = to.joint(0) + first_row * block_lanes + to_lane;
    for (std::size_t row = 0; row < rows; ++row) out[row * block_lanes] = source[row * block_lanes];
}

}  // namespace

WorkRoom::WorkRoom(std::size_t bones) : tile(Block::floats(bones)) {
    scalar.resize(bones);
}

void Stragglers::push(std::span<const std::uint32_t> chains) noexcept {
    const std::lock_guard lock(mutex_);
    for (const std::uint32_t chain : chains) list_[last_++] = chain;
}

std::size_t Stragglers::pop(std::span<std::uint32_t> out) noexcept {
    const std::lock_guard lock(mutex_);
    const std::size_t count = std::min(out.size(), last_ - first_);
    for (std::size_t i = 0; i < count; ++i) out[i] = list_[first_++];
    return count;
}

void Work::run(WorkRoom& room) noexcept {
    const std::size_t blocks = (chains_ + block_lanes - 1) / block_lanes;
    for (std::size_t index; (index = next_block_.fetch_add(1)) < blocks;) solve_block(index, room);
    solve_stragglers(room);
}

void Work::set_up(const Block& block, std::size_t first, std::size_t lanes) const noexcept {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const float of_reach = 1e-3f * block.at(Row::Reach, lane);
        block.at(Row::Tolerance, lane) = options_.tolerance.value_or(of_reach);
        block.set_target(lane, targets_[first + lane]);
    }
}

void Work::solve_block(std::size_t index, WorkRoom& room) noexcept {
    const Block block = this->block(index);
    const std::size_t first = index * block_lanes, lanes = std::min(block_lanes, chains_ - first);
    set_up(block, first, lanes);
    pull_block(block, lanes, unit_.look(block, lanes, options_.every_iteration));

    std::array<std::uint32_t, block_lanes> late;
    std::size_t late_count = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::size_t chain = first + lane;
        if (block.start(lane) == Start::Careful) {
            solve_careful(block, lane, chain, room);
        } else if (block.at(Row::Active, lane) > 0.0f) {
            late[late_count++] = static_cast<std::uint32_t>(chain);
        } else {
            report(block, lane, chain);
        }
    }
    if (late_count > 0) stragglers_.push({late.data(), late_count});
}

/// Where a few keep a whole block waiting they are left active: they go on elsewhere, together with those of
/// other blocks.
void Work::pull_block(const Block& block, std::size_t lanes, std::size_t active) const noexcept {
    const bool alone = options_.every_iteration || chains_ <= block_lanes;
    const PullOrder order{alone ? options_.max_iterations : short_burst, options_.max_iterations,
                          options_.every_iteration};
    if (active > 0) active = unit_.pull(block, lanes, order);
    while (active > few) active = unit_.pull(block, lanes, order);
}

/// Line traps, folded chains and whatever floats cannot tell from them: rare, and so left to the scalar code.
void Work::solve_careful(const Block& block, std::size_t lane, std::size_t chain,
                         WorkRoom& room) const noexcept {
    for (std::size_t i = 0; i <= bones_; ++i) room.scalar.joints[i] = block.point(i, lane);
    for (std::size_t i = 0; i < bones_; ++i) room.scalar.lengths[i] = block.length(i)[lane];
    room.scalar.reach = block.at(Row::Reach, lane);
    room.scalar.longest = block.at(Row::Longest, lane);
    Problem problem{room.scalar.joints, block.target(lane), block.at(Row::Tolerance, lane), options_,
                    room.scalar};
    lay_to_lengths(problem, Unwatched());
    const Method method = is_on_one_line(problem) ? Method::Fabrik : Method::FabrikPlain;
    const Report answer = ik::detail::run(method, problem, Unwatched());
    for (std::size_t i = 1; i <= bones_; ++i) block.set_point(i, lane, room.scalar.joints[i]);
    if (!reports_.empty()) reports_[chain] = answer;
}

void Work::put_into_tile(const Block& tile, std::size_t lane, std::size_t chain) const noexcept {
    copy_lane(block(chain / block_lanes), chain % block_lanes, tile, lane, 0, Block::rows(bones_));
}

void Work::take_from_tile(const Block& tile, std::size_t lane, std::size_t chain) const noexcept {
    copy_lane(tile, lane, block(chain / block_lanes), chain % block_lanes, 3, 3 * bones_);  // not the root
    report(tile, lane, chain);
}

/// Whenever chains in the tile are done, others take their lanes.
void Work::solve_stragglers(WorkRoom& room) noexcept {
    const Block tile(room.tile.get(), bones_);
    std::size_t used = 0;  // lanes
    while ((used = refill(tile, used, room)) > 0) {
        unit_.pull(tile, used, {long_burst, options_.max_iterations, false});
    }
}

/// Takes out what is done and puts in what waits; what is left then lies in the first lanes, as many as are
/// returned.
std::size_t Work::refill(const Block& tile, std::size_t used, WorkRoom& room) noexcept {
    const auto is_done = [&](std::size_t lane) { return !(tile.at(Row::Active, lane) > 0.0f); };
    std::array<std::size_t, block_lanes> free;
    std::size_t free_count = 0;
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        if (lane < used && !is_done(lane)) continue;
        if (lane < used) take_from_tile(tile, lane, room.chains[lane]);
        free[free_count++] = lane;
    }
    std::array<std::uint32_t, block_lanes> fresh;
    const std::size_t added = stragglers_.pop({fresh.data(), free_count});
    for (std::size_t i = 0; i < added; ++i) {
        put_into_tile(tile, free[i], fresh[i]);
        room.chains[free[i]] = fresh[i];
        used = std::max(used, free[i] + 1);
    }
    for (std::size_t i = added; i < free_count; ++i) {
        while (used > 0 && is_done(used - 1)) --used;
        if (free[i] >= used) break;
        --used;
        copy_lane(tile, used, tile, free[i], 0, Block::rows(bones_));
        room.chains[free[i]] = room.chains[used];
        tile.at(Row::Active, used) = 0.0f;
    }
    return used;
}

void Work::report(const Block& block, std::size_t lane, std::size_t chain) const noexcept {
    if (reports_.empty()) return;
    Report& report = reports_[chain];
    report.iterations = static_cast<int>(block.at(Row::Iterations, lane));
    report.residual = block.at(Row::Residual, lane);
    switch (block.start(lane)) {
        case Start::Invalid:
            report = {Status::InvalidInput, 0, 0.0f};
            return;
        case Start::Straight:
            report.status = Status::Stretched;
            return;
        case Start::Plain:
        case Start::Careful:
            const bool stalled = block.at(Row::Idle, lane) >= static_cast<float>(stall_patience);
            report.status = report.residual <= block.at(Row::Tolerance, lane) ? Status::Converged
                            : stalled                                         ? Status::Stalled
                                                                              : Status::IterationLimit;
    }
}

}  // namespace tendril::ik::detail
