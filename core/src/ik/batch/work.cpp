#include "ik/batch/work.hpp"

#include <algorithm>

#include "ik/math.hpp"
#include "ik/pole/pole.hpp"
#include "ik/solve/loop.hpp"
#include "ik/solve/perturbation.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

constexpr auto min_active =
    static_cast<std::size_t>(static_cast<double>(block_lanes) * tune::batch::block_part);

/// Copies whole chains to consecutive lanes from `at` on.
void gather_chains(const Block& from, const LaneList& lanes, const Block& to, std::size_t at) noexcept {
    const std::size_t bones = from.bones();
    gather_lanes(from.joint(0), lanes.span(), to.joint(0) + at, Block::joint_rows(bones));
    gather_lanes(from.length(0), lanes.span(), to.length(0) + at, Block::length_rows(bones));
    gather_lanes(from.target(), lanes.span(), to.target() + at, state_rows);
    for (std::size_t k = 0; k < lanes.count; ++k) {
        if (to.at(Row::Saved, at + k) != 0.0f)
            copy_lane(from.best(1) + lanes.lanes[k], to.best(1) + at + k, 3 * bones);
    }
}

/// Called after a perturbation; like Convergence::restart (convergence.hpp).
void restart(const Block& block, std::size_t lane, const Problem& problem) noexcept {
    const float residual = problem.residual();
    block.save_best(lane);
    for (std::size_t i = 1; i < problem.joints.size(); ++i) block.set_point(i, lane, problem.joints[i]);
    block.at(Row::Nearest, lane) = block.at(Row::Last, lane) = residual;
    block.at(Row::Idle, lane) = block.at(Row::Slow, lane) = 0.0f;
}

}  // namespace

Scratch::Scratch(std::size_t bones)
    : joints(Block::joint_floats(bones)),
      state(Block::state_floats(bones)),
      shapes(shape_floats(bones)),
      gathered(bones),
      second(bones),
      tile(bones) {
    // Unused lanes take part in the passes, so they must not contain NaN.
    std::fill_n(joints.get(), Block::joint_floats(bones), 0.0f);
    std::fill_n(state.get(), Block::state_floats(bones), 0.0f);
    for (Tile* each : {&tile, &gathered, &second}) {
        std::fill_n(each->rows.get(), Block::chain_floats(bones), 0.0f);
        std::fill_n(each->state.get(), Block::state_floats(bones), 0.0f);
    }
    scalar.resize(bones);
}

void Work::run(Scratch& scratch) noexcept {
    scratch.options = in_.options;
    if (planar_) scratch.options.plane->normal = {0.0f, 1.0f, 0.0f};
    const std::size_t blocks = (in_.chains + block_lanes - 1) / block_lanes;
    for (std::size_t index; (index = next_block_.fetch_add(1)) < blocks;) solve_block(index, scratch);
    in_.limits != nullptr ? run_limited_tile(0, scratch) : run_tile(0, scratch);
}

void Work::solve_block(std::size_t index, Scratch& scratch) noexcept {
    const Block block = this->block(index, scratch);
    const std::size_t first = index * block_lanes, lanes = std::min(block_lanes, in_.chains - first);
    in_.unit.set_targets(block, lanes, &in_.targets[first], in_.options.tolerance.value_or(-1.0f));
    if (in_.options.plane && !planar_) return solve_angled_block(index, lanes, scratch);
    if (planar_) {
        project_to_plane(block, first, lanes, scratch);
    } else if (in_.joints != nullptr) {
        take_joints(block, index, lanes);
    }
    if (in_.limits != nullptr) return solve_limited_block(block, index, lanes, scratch);
    in_.unit.classify(block, lanes);
    if (planar_) rotate_to_targets(block, first, lanes, scratch);
    const Remaining left = in_.unit.begin(block, lanes, in_.options.every_iteration, planar_);
    for (std::size_t lane = 0; left.perturb && lane < lanes; ++lane) {
        if (block.class_of(lane) == Class::Collinear) bend_collinear(block, lane, scratch);
    }
    if (left.active > 0) iterate_block(block, lanes, scratch);
    LaneList active;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const bool scalar = block.class_of(lane) == Class::Scalar;
        if (scalar) {
            planar_ ? solve_in_plane(first + lane, scratch)
                    : solve_scalar(block, lane, first + lane, scratch);
        } else {
            report(block, lane, first + lane);  // for active chains again, when they are done
            if (planar_ && block.activity(lane) == Activity::Done)
                return_from_plane(block, lane, first + lane, scratch);
        }
        // Without a branch, which would be mispredicted.
        active.lanes[active.count] = static_cast<std::uint8_t>(lane);
        active.count += !scalar && block.activity(lane) != Activity::Done ? 1 : 0;
    }
    if (in_.joints != nullptr && !planar_) return_joints(block, index, lanes);
    if (active.count > 0) put_into_tile(block, active, first, scratch);  // may write joints of this block
}

void Work::take_joints(const Block& block, std::size_t index, std::size_t lanes) const noexcept {
    const std::size_t each = in_.bones + 1;
    in_.unit.copy_in(&in_.joints[index * block_lanes * each].x, lanes, 3 * each, block.joint(0));
}

void Work::return_joints(const Block& block, std::size_t index, std::size_t lanes) const noexcept {
    const std::size_t each = in_.bones + 1;
    in_.unit.copy_out(block.joint(0), lanes, 3 * each, &in_.joints[index * block_lanes * each].x);
}

/// Stops once few chains are active: these continue in the tile with other blocks' chains.
void Work::iterate_block(const Block& block, std::size_t lanes, Scratch& scratch) const noexcept {
    const bool single_block = in_.options.every_iteration || in_.chains <= block_lanes;
    const int burst =
        in_.bones < tune::chain::few_bones ? tune::batch::first_burst_few_bones : tune::batch::first_burst;
    std::size_t active = 0;
    do {
        active = iterate(block, lanes, single_block ? in_.options.max_iterations : burst, scratch).active;
    } while (active > (single_block ? 0 : min_active));
}

/// Iterates a block or a tile, including perturbations.
Remaining Work::iterate(const Block& block, std::size_t lanes, int iterations,
                        Scratch& scratch) const noexcept {
    const IterateJob job{iterations,
                         in_.options.max_iterations,
                         in_.options.every_iteration,
                         {scratch.shapes.get(), scratch.gathered.block, scratch.second.block}};
    const Remaining left = in_.unit.iterate(block, lanes, job);
    for (std::size_t lane = 0; left.perturb && lane < lanes; ++lane) {
        if (block.activity(lane) == Activity::Perturb) perturb(block, lane, scratch);
    }
    return left;
}

/// Copies one chain to the scalar workspace.
Problem Work::load_problem(const Block& block, std::size_t lane, Scratch& scratch) const noexcept {
    Workspace& scalar = scratch.scalar;
    for (std::size_t i = 0; i <= in_.bones; ++i) scalar.joints[i] = block.point(i, lane);
    for (std::size_t i = 0; i < in_.bones; ++i) scalar.lengths[i] = block.length(i)[lane];
    scalar.reach = block.reach()[lane];
    scalar.longest = block.longest()[lane];
    if (planar_) scratch.options.plane->bend = static_cast<Side>(static_cast<int>(block.at(Row::Side, lane)));
    return {scalar.joints,
            block.target_of(lane),
            block.at(Row::Tolerance, lane),
            planar_ ? scratch.options : in_.options,
            scalar,
            scalar.saved};
}

/// Perturbs a stalled chain, as loop.cpp does.
void Work::perturb(const Block& block, std::size_t lane, Scratch& scratch) const noexcept {
    Problem problem = load_problem(block, lane, scratch);
    float& count = block.at(Row::Perturbations, lane);
    ik::detail::perturb(problem, static_cast<int>(count), Unwatched());
    count += 1.0f;
    restart(block, lane, problem);
    block.set_activity(lane, Activity::Active);
}

/// Bends a chain that is collinear with its target, as loop.cpp does before the first iteration.
void Work::bend_collinear(const Block& block, std::size_t lane, Scratch& scratch) const noexcept {
    Problem problem = load_problem(block, lane, scratch);
    if (!bend_to_pole(problem, Unwatched())) {
        if (!is_collinear(problem)) return;
        bend_collinear_chain(problem, Unwatched());
    }
    restart(block, lane, problem);
    block.at(Row::Residual, lane) = block.at(Row::Last, lane);
    const bool converged = block.at(Row::Residual, lane) <= problem.tolerance;
    if (converged && !in_.options.every_iteration) block.set_activity(lane, Activity::Done);
}

void Work::solve_scalar(const Block& block, std::size_t lane, std::size_t chain, Scratch& scratch) noexcept {
    Problem problem = load_problem(block, lane, scratch);
    const Report answer = ik::detail::run(Method::Fabrik, problem, Unwatched());
    for (std::size_t i = 1; i <= in_.bones; ++i) block.set_point(i, lane, scratch.scalar.joints[i]);
    report_fallback(chain, answer);
}

void Work::report_fallback(std::size_t chain, const Report& answer) noexcept {
    scalar_fallbacks_.fetch_add(1, std::memory_order_relaxed);
    if (in_.reports.empty()) return;
    in_.reports[chain] = {answer.status, true, answer.iterations, answer.residual};
}

void Work::put_into_tile(const Block& from, const LaneList& lanes, std::size_t first,
                         Scratch& scratch) noexcept {
    Tile& tile = scratch.tile;
    if (tile.used + lanes.count > block_lanes) run_tile(block_lanes - lanes.count, scratch);
    gather_chains(from, lanes, tile.block, tile.used);
    for (const std::size_t lane : lanes.span()) {
        tile.chains[tile.used++] = static_cast<std::uint32_t>(first + lane);
    }
}

/// Iterates until at most `most_left` chains are in the tile.
void Work::run_tile(std::size_t most_left, Scratch& scratch) noexcept {
    Tile& tile = scratch.tile;
    while (tile.used > most_left) {
        iterate(tile.block, tile.used, tune::batch::next_burst, scratch);
        retire_done(scratch);
    }
}

/// Writes back the finished chains and closes the gaps.
void Work::retire_done(Scratch& scratch) noexcept {
    Tile& tile = scratch.tile;
    LaneList left, done;
    for (std::size_t lane = 0; lane < tile.used; ++lane) {
        (tile.block.activity(lane) != Activity::Done ? left : done).add(lane);
    }
    for (const std::size_t lane : done.span()) {
        write_back_joints(lane, scratch);
        report(tile.block, lane, tile.chains[lane]);
    }
    if (left.count == tile.used) return;
    gather_chains(tile.block, left, tile.block, 0);
    for (std::size_t i = 0; i < left.count; ++i) tile.chains[i] = tile.chains[left.lanes[i]];
    for (std::size_t lane = left.count; lane < tile.used; ++lane) {
        tile.block.set_activity(lane, Activity::Done);
    }
    tile.used = left.count;
}

/// Writes the joints of a chain in the tile back to its block or to the caller.
void Work::write_back_joints(std::size_t lane, Scratch& scratch) const noexcept {
    const Tile& tile = scratch.tile;
    if (planar_) return return_from_plane(tile.block, lane, tile.chains[lane], scratch);
    const std::size_t chain = tile.chains[lane], each = in_.bones + 1;
    if (in_.joints != nullptr) {
        for (std::size_t i = 1; i < each; ++i) in_.joints[chain * each + i] = tile.block.point(i, lane);
    } else {
        float* const rows = in_.blocks + chain / block_lanes * Block::chain_floats(in_.bones);
        copy_lane(tile.block.joint(1) + lane, rows + 3 * block_lanes + chain % block_lanes, 3 * in_.bones);
    }
}

/// The inverse of write_back_joints().
void Work::fetch_joints(const Tile& tile, std::size_t lane) const noexcept {
    const std::size_t chain = tile.chains[lane], each = in_.bones + 1;
    if (in_.joints != nullptr) {
        for (std::size_t i = 0; i < each; ++i) tile.block.set_point(i, lane, in_.joints[chain * each + i]);
    } else {
        const float* const rows = in_.blocks + chain / block_lanes * Block::chain_floats(in_.bones);
        copy_lane(rows + chain % block_lanes, tile.block.joint(0) + lane, Block::joint_rows(in_.bones));
    }
}

void Work::report_invalid(std::size_t chain) noexcept {
    invalid_.fetch_add(1, std::memory_order_relaxed);
    std::size_t first = first_invalid_.load();
    while (chain < first && !first_invalid_.compare_exchange_weak(first, chain)) {
    }
    if (!in_.reports.empty()) in_.reports[chain] = refused_chain;
}

void Work::report(const Block& block, std::size_t lane, std::size_t chain) noexcept {
    const Class found = block.class_of(lane);
    if (found == Class::Invalid) return report_invalid(chain);
    if (in_.reports.empty()) return;
    ManyReport& report = in_.reports[chain];
    const float residual = block.at(Row::Residual, lane);
    const bool converged = residual <= block.at(Row::Tolerance, lane);
    const bool stalled = block.at(Row::Idle, lane) >= static_cast<float>(tune::chain::stall_window);
    Status status = converged ? Status::Converged : stalled ? Status::Stalled : Status::IterationLimit;
    if (found == Class::Straight) status = Status::Stretched;
    if (found == Class::Folded) status = Status::TooClose;
    report = {status, false, static_cast<int>(block.at(Row::Iterations, lane)), residual};
}

}  // namespace tendril::ik::detail
