// Chains within limits: damped least squares over the joints' rotations, a register of chains at a time.
//
// The scalar solver alternates FABRIK's passes with such steps and starts again elsewhere where both end;
// what it converges by, as a rule, are the steps. Here there is nothing else: from the pose that a chain has,
// the tip goes to its target by Levenberg's steps (K. Levenberg 1944; damping by whether the last step
// brought the tip nearer), with what a limit stops taken out of the matrix, and every joint clamped. A chain
// that does not arrive so is left as it was, for the scalar solver.
//
// Highway compiles this file once for each vector unit: it includes it again and again, each time with
// another HWY_NAMESPACE.
#include <algorithm>
#include <array>
#include <utility>

#include "ik/batch/vector.hpp"
#include "math/dispatch.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ik/batch/limited.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

#include "ik/batch/limb-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

// Chosen by measuring: the most iterations that any of 16 chains takes.
constexpr float first_damping = 2e-2f, min_damping = 1e-8f, max_damping = 1.0f;
constexpr float first_move = 1.0f;       ///< of the reach, that a step is to bring the tip nearer
constexpr int most_passes = 3;           ///< in which what the limits stop is found
constexpr int steps_between_checks = 2;  ///< of who is done
constexpr int most_iterations = 30;      ///< after that the scalar solver takes over
constexpr float little = 0.1f;           ///< a gain of less than this part of what is left
constexpr float patience = 8.0f;         ///< so many times in a row

// What each chain's solve keeps between two steps, in the tile's rows of state.
constexpr Row row_of_error = Row::Residual, row_of_damping = Row::Best, row_of_move = Row::Nearest,
              row_of_slow = Row::Slow;

/// The state that a register's chains begin with. Chains that have arrived and violate nothing are done as
/// they are.
HWY_INLINE void begin(const Limb& limb, const float* rotations) {
    const Mask asked = equals(limb.row(Row::Class), Class::Reachable);
    const Mask violated = take_pose(limb, rotations);
    const Lanes tolerance = load(limb.row(Row::Tolerance));
    const Mask rests = hn::AndNot(violated, hn::Le(load(limb.row(Row::Residual)), tolerance));
    const Mask left = hn::AndNot(rests, asked);
    store(hn::IfThenElseZero(left, all(static_cast<float>(Activity::Active))), limb.row(Row::Activity));
    store(hn::IfThenElse(left, error_of(limb, limb.pose), load(limb.row(row_of_error))),
          limb.row(row_of_error));
    store(all(first_damping), limb.row(row_of_damping));
    store(all(first_move), limb.row(row_of_move));
    store(zero(), limb.row(row_of_slow));
    store(zero(), limb.row(Row::Iterations));
}

/// One step of the active chains of a register.
HWY_INLINE void take_step(const Limb& limb, Mask left, float last) {
    const Lanes error = load(limb.row(row_of_error)), damping = load(limb.row(row_of_damping)),
                move = load(limb.row(row_of_move)), tolerance = load(limb.row(Row::Tolerance));
    linearize(limb);
    const Lanes unit = hn::Div(all(1.0f), load(limb.block.reach() + limb.i));
    const Lanes bounded = hn::Min(hn::Mul(error, unit), move);
    const Points wanted =
        times(minus(limb.target(), limb.tip(limb.pose)), hn::Div(bounded, hn::Max(error, all(1e-30f))));
    for (int pass = 0; pass < most_passes; ++pass) {
        if (!change_joints(limb, matrix_of(limb, damping).solved(wanted), left)) break;
    }
    turn_joints(limb);
    const Lanes trial = error_of(limb, limb.trial);
    const Mask nearer = hn::And(left, hn::Lt(trial, error));
    const Mask progresses = hn::Lt(trial, hn::Mul(error, all(1.0f - little)));
    accept(limb, nearer);
    const auto update = [&](Row which, Lanes yes, Lanes no) {
        store(hn::IfThenElse(left, hn::IfThenElse(nearer, yes, no), load(limb.row(which))), limb.row(which));
    };
    update(row_of_damping, hn::Max(hn::Mul(damping, all(0.3f)), all(min_damping)),
           hn::Min(hn::Mul(damping, all(5.0f)), all(max_damping)));
    update(row_of_move, hn::Min(hn::Mul(move, all(2.0f)), all(1.0f)), hn::Mul(move, all(0.4f)));
    update(row_of_error, trial, error);
    const Lanes slow = hn::IfThenZeroElse(progresses, hn::Add(load(limb.row(row_of_slow)), all(1.0f)));
    const Lanes done = hn::Add(load(limb.row(Row::Iterations)), all(1.0f));
    update(row_of_slow, slow, slow);
    update(Row::Iterations, done, done);
    const Mask over = hn::Or(hn::Ge(slow, all(patience)), hn::Ge(done, all(last)));
    const Mask ends = hn::And(left, hn::Or(over, hn::Le(load(limb.row(row_of_error)), tolerance)));
    store(hn::IfThenZeroElse(ends, load(limb.row(Row::Activity))), limb.row(Row::Activity));
}

/// Chains of a block, side by side while they are solved; those that are done go home, and others take their
/// lanes.
class LimitedTile {
  public:
    LimitedTile(const Block& home, std::size_t lanes, const LimitedOrder& order)
        : home_(home), order_(order), used_(lanes) {
        for (std::size_t lane = 0; lane < lanes; ++lane) lanes_[lane] = static_cast<std::uint8_t>(lane);
        const std::size_t bones = home.bones();
        std::copy_n(home.joint(0), Block::joint_floats(bones), order.tile.joint(0));
        std::copy_n(home.length(0), Block::length_rows(bones) * block_lanes, order.tile.length(0));
        std::copy_n(home.target(), state_rows * block_lanes, order.tile.target());
        for (std::size_t i = 0; i < lanes; i += Column::width()) begin(Limb(i, order), order.rotations);
    }

    void solve() {
        const int most = std::min(order_.max_iterations, most_iterations);
        for (clear_done(); used_ > 0; clear_done()) {
            for (std::size_t i = 0; i < used_; i += Column::width()) {
                const Limb limb(i, order_);
                for (int step = 0; step < steps_between_checks; ++step) {
                    const Mask left = equals(limb.row(Row::Activity), Activity::Active);
                    if (!any(left)) break;
                    take_step(limb, left, static_cast<float>(most));
                }
            }
        }
    }

  private:
    /// Chains are moved only where that leaves a register empty: it costs about as much as half a step.
    void clear_done() {
        const Block& tile = order_.tile;
        std::size_t active = 0;
        for (std::size_t slot = 0; slot < used_; ++slot) {
            if (tile.activity(slot) == Activity::Active) {
                ++active;
            } else if (lanes_[slot] != gone) {
                go_home(slot);
                lanes_[slot] = gone;
            }
        }
        const std::size_t width = Column::width(), needed = (active + width - 1) / width * width;
        for (std::size_t hole = 0; used_ > needed; --used_) {
            const std::size_t last = used_ - 1;
            if (lanes_[last] == gone) continue;
            while (lanes_[hole] != gone) ++hole;
            move(last, hole);
        }
    }
    void move(std::size_t from, std::size_t to) {
        const Block& tile = order_.tile;
        const std::size_t bones = home_.bones();
        copy_lane(tile.joint(0) + from, tile.joint(0) + to, Block::chain_floats(bones) / block_lanes);
        copy_lane(tile.target() + from, tile.target() + to, state_rows);
        copy_lane(order_.poses + from, order_.poses + to, pose_rows(bones));
        lanes_[to] = std::exchange(lanes_[from], gone);
        tile.set_activity(from, Activity::Done);
    }
    /// A chain that has arrived writes joints and rotations; one that has not stays as it was. One that was
    /// never active has nothing to write.
    void go_home(std::size_t slot) const {
        const Block& tile = order_.tile;
        const std::size_t lane = lanes_[slot], bones = home_.bones();
        if (tile.at(Row::Iterations, slot) == 0.0f) return;
        if (!(tile.at(Row::Residual, slot) <= tile.at(Row::Tolerance, slot))) {
            home_.at(Row::Class, lane) = static_cast<float>(Class::Scalar);
            return;
        }
        const float* const joints = order_.poses + slot;
        const float* const world = joints + (3 * (bones + 1) + 4 * bones) * block_lanes;
        copy_lane(joints + 3 * block_lanes, home_.joint(1) + lane, 3 * bones);
        for (std::size_t bone = 0; bone < bones; ++bone) {
            const float* const from = world + 4 * bone * block_lanes;
            float* const to = order_.rotations + 4 * bone * block_lanes + lane;
            to[row_of_w] = from[0];
            copy_lane(from + block_lanes, to + row_of_v, 3);
        }
        home_.at(Row::Residual, lane) = tile.at(Row::Residual, slot);
        home_.at(Row::Iterations, lane) = tile.at(Row::Iterations, slot);
    }

    static constexpr std::uint8_t gone = 255;

    Block home_;
    const LimitedOrder& order_;
    std::array<std::uint8_t, block_lanes> lanes_{};
    std::size_t used_;
};

void solve_limited(const Block& block, std::size_t lanes, const LimitedOrder& order) {
    LimitedTile(block, lanes, order).solve();
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::ik::detail {
namespace {
HWY_EXPORT(solve_limited);
}

SolveLimited* solve_limited_with(std::int64_t target) noexcept {
    return TENDRIL_COMPILED_FOR(solve_limited, target);
}

}  // namespace tendril::ik::detail
#endif
