// Chains within limits: damped least squares over the joints' rotations, a register of chains at a time.
//
// The scalar solver alternates FABRIK's passes with such steps and restarts elsewhere if both stall; usually
// the steps converge. Here there are only steps: from a chain's given pose, the tip moves to its target by
// Levenberg's method (K. Levenberg 1944; the damping falls if the last step brought the tip nearer and grows
// otherwise), with the directions that a limit stops removed from the matrix, and every joint clamped. A
// chain that does not converge this way is left unchanged, for the scalar solver.
#include <algorithm>

#include "ik/batch/vector.hpp"
#include "ik/tunables.hpp"

#define HWY_TARGET_INCLUDE "ik/batch/limited.cpp"
#include "math/each_target-inl.hpp"

#include "ik/batch/limb-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

// State of each chain between two steps, in the tile's rows.
constexpr Row row_of_error = Row::Residual, row_of_damping = Row::Best, row_of_move = Row::Nearest,
              row_of_slow = Row::Slow;

/// Initialises the state of a register's chains. Those that have arrived within their limits are done.
HWY_INLINE void begin(const Limb& limb, float* rotations) {
    const Mask requested = equals(limb.row(Row::Class), Class::Reachable);
    const Mask violated = load_clamped_pose(limb, rotations);
    const Lanes tolerance = load(limb.row(Row::Tolerance));
    const Mask at_goal = hn::AndNot(violated, hn::Le(load(limb.row(Row::Residual)), tolerance));
    const Mask left = hn::AndNot(at_goal, requested);
    if (const Mask stays = hn::And(requested, at_goal); any(stays)) transport(limb, stays, rotations);
    store(hn::IfThenElseZero(left, all(static_cast<float>(Activity::Active))), limb.row(Row::Activity));
    store(hn::IfThenElse(left, error_of(limb, limb.pose), load(limb.row(row_of_error))),
          limb.row(row_of_error));
    store(all(tune::batch::first_damping), limb.row(row_of_damping));
    store(all(tune::batch::first_move), limb.row(row_of_move));
    store(zero(), limb.row(row_of_slow));
    store(zero(), limb.row(Row::Iterations));
}

/// One step of the active chains of a register.
HWY_INLINE void take_step(Limb& limb, Mask left, float last) {
    using namespace tune::batch;
    const Lanes error = load(limb.row(row_of_error)), damping = load(limb.row(row_of_damping)),
                move = load(limb.row(row_of_move)), tolerance = load(limb.row(Row::Tolerance));
    linearize(limb);
    const Lanes unit = hn::Div(all(1.0f), load(limb.block.reach() + limb.i));
    const Lanes bounded = hn::Min(hn::Mul(error, unit), move);
    const Points wanted =
        times(minus(limb.target(), limb.tip(limb.pose)), hn::Div(bounded, hn::Max(error, all(1e-30f))));
    for (int pass = 0; pass < passes; ++pass) {
        if (!change_joints(limb, matrix_of(limb, damping).solved(wanted), left)) break;
    }
    turn_joints(limb);
    const Lanes trial = error_of(limb, limb.trial);
    const Mask nearer = hn::And(left, hn::Lt(trial, error));
    const Mask decreases = hn::Lt(trial, hn::Mul(error, all(1.0f - min_decrease)));
    accept(limb, nearer);
    const auto update = [&](Row which, Lanes yes, Lanes no) {
        store(hn::IfThenElse(left, hn::IfThenElse(nearer, yes, no), load(limb.row(which))), limb.row(which));
    };
    const auto by = [](Lanes x, float factor) { return hn::Mul(x, all(factor)); };
    update(row_of_damping, hn::Max(by(damping, damping_falls), all(min_damping)),
           hn::Min(by(damping, damping_grows), all(max_damping)));
    update(row_of_move, hn::Min(by(move, move_grows), all(max_move)), by(move, move_falls));
    update(row_of_error, trial, error);
    const Lanes slow = hn::IfThenZeroElse(decreases, hn::Add(load(limb.row(row_of_slow)), all(1.0f)));
    const Lanes done = hn::Add(load(limb.row(Row::Iterations)), all(1.0f));
    update(row_of_slow, slow, slow);
    update(Row::Iterations, done, done);
    const Mask over = hn::Or(hn::Ge(slow, all(static_cast<float>(max_slow_steps))), hn::Ge(done, all(last)));
    const Mask ends = hn::And(left, hn::Or(over, hn::Le(load(limb.row(row_of_error)), tolerance)));
    store(hn::IfThenZeroElse(ends, load(limb.row(Row::Activity))), limb.row(Row::Activity));
}

/// Writes joints and rotations of the chains that converged. The others stay unchanged; those that ended
/// without converging are left to the scalar solver.
HWY_INLINE void write_back(const Limb& limb, Mask left, float* rotations) {
    const Mask taken = hn::AndNot(left, hn::Gt(load(limb.row(Row::Iterations)), zero()));
    const Mask converged = hn::Le(load(limb.row(row_of_error)), load(limb.row(Row::Tolerance)));
    const Mask arrived = hn::And(taken, converged);
    float* const found = limb.row(Row::Class);
    const Lanes scalar = all(static_cast<float>(Class::Scalar));
    store(hn::IfThenElse(hn::AndNot(converged, taken), scalar, load(found)), found);
    if (!any(arrived)) return;
    for (std::size_t bone = 0; bone < limb.count(); ++bone) {
        float* const joint = limb.block.joint(bone + 1) + limb.i;
        store_points(select(arrived, limb.pose.joints.points(bone + 1), load_points(joint)), joint);
        float* const rows = rotations + 4 * bone * block_lanes + limb.i;
        store_rotations(select(arrived, limb.pose.world.rotations(bone), load_rotations(rows)), rows);
    }
}

/// Moves a chain to a lane of the tile.
HWY_INLINE void move_chain(const Limb& limb, std::size_t lane, std::size_t to, const LimitedJob& job) {
    const Block &block = limb.block, &tile = job.tile;
    const std::size_t from = limb.i + lane, bones = block.bones();
    copy_lane(block.joint(0) + from, tile.joint(0) + to, 3);
    copy_lane(block.length(0) + from, tile.length(0) + to, Block::length_rows(bones));
    copy_lane(block.target() + from, tile.target() + to, state_rows);
    for (std::size_t row = 0; row < pose_rows(bones); ++row) {
        job.poses[row * block_lanes + to] = limb.pose.rows().lane(row, lane);
    }
}

HWY_INLINE Mask active(const Limb& limb) {
    return equals(limb.row(Row::Activity), Activity::Active);
}

HWY_INLINE float last_iteration(const LimitedJob& job) {
    return static_cast<float>(std::min(job.max_iterations, tune::batch::max_steps));
}

LaneList solve_limited(const Block& block, std::size_t lanes, float* rotations, std::size_t used,
                       const LimitedJob& job) {
    const Floats d;
    LaneList leftover;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        Limb limb(block, i, job);
        begin(limb, rotations);
        Mask left = active(limb);
        for (; hn::CountTrue(d, left) > leftover_lanes(hn::Lanes(d)); left = active(limb)) {
            take_step(limb, left, last_iteration(job));
        }
        write_back(limb, left, rotations);
        for_each_lane(left, [&](std::size_t lane) {
            move_chain(limb, lane, used + leftover.count, job);
            leftover.add(i + lane);
        });
    }
    return leftover;
}

void step_limited(std::size_t used, const LimitedJob& job) {
    for (std::size_t i = 0; i < used; i += hn::Lanes(Floats())) {
        Limb limb(job.tile, i, job);
        const std::size_t rows = pose_rows(limb.count());
        const auto at = [&](std::size_t row) { return job.poses + row * block_lanes + i; };
        for (std::size_t row = 0; row < rows; ++row) limb.pose.rows().set(row, load(at(row)));
        forward_kinematics(limb, limb.pose);
        Mask left = active(limb);
        for (int step = 0; step < tune::batch::steps && any(left); ++step, left = active(limb)) {
            take_step(limb, left, last_iteration(job));
        }
        write_back(limb, left, job.rotations);
        for (std::size_t row = 0; row < rows; ++row) store(limb.pose.rows().lanes(row), at(row));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::ik::detail {
namespace {
HWY_EXPORT(solve_limited);
HWY_EXPORT(step_limited);
}  // namespace

SolveLimited* solve_limited_with(std::int64_t target) noexcept {
    return TENDRIL_COMPILED_FOR(solve_limited, target);
}
StepLimited* step_limited_with(std::int64_t target) noexcept {
    return TENDRIL_COMPILED_FOR(step_limited, target);
}

}  // namespace tendril::ik::detail
#endif
