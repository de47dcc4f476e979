// The iterations of solve_many, block by block: FABRIK's two passes, the step of shape-inl.hpp, and how each
// chain goes on, as solve/loop.cpp and solve/convergence.hpp have it.
//
// Highway compiles this file once for each vector unit: it includes it again and again, each time with
// another HWY_NAMESPACE.
#include <array>

#include "ik/batch/vector.hpp"

// Adds nothing for floats, and some versions do not compile with it as the baseline (-march=native).
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ik/batch/iterate.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

#include "ik/batch/shape-inl.hpp"
#include "ik/batch/step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

// As in fabrik.cpp and convergence.hpp.
constexpr std::size_t few_bones = 8;
constexpr float stall_patience = 10.0f, slow_patience = 2.0f, most_perturbations = 4.0f;

/// Which registers of a block have chains to iterate, and whether in each of these all lanes do.
struct Registers {
    std::array<std::uint16_t, block_lanes> first;
    std::size_t count = 0;
    bool whole = true;
};

HWY_INLINE Mask active_lanes(const Block& block, std::size_t i) {
    return equals(block.row(Row::Activity) + i, Activity::Active);
}

HWY_INLINE Registers active_registers(const Block& block, std::size_t lanes) {
    const Floats d;
    Registers registers;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const Mask active = active_lanes(block, i);
        if (!any(active)) continue;
        registers.first[registers.count++] = static_cast<std::uint16_t>(i);
        registers.whole = registers.whole && hn::AllTrue(d, active);
    }
    return registers;
}

/// Forward reaching, then backward reaching. The registers take each step side by side, so that none waits
/// for its own square root.
template <bool some>
HWY_INLINE void reach_both_ways(const Block& block, const Registers& registers) {
    const std::size_t bones = block.bones();
    const float* const activity = block.row(Row::Activity);
    for (std::size_t k = 0; k < registers.count; ++k) {
        const std::size_t i = registers.first[k];
        float* const tip = block.joint(bones) + i;
        const Points target = load_points(block.target() + i);
        store_points(some ? select(active_lanes(block, i), target, load_points(tip)) : target, tip);
    }
    // Where the root would be drawn to does not matter: it stays.
    for (std::size_t bone = bones; bone-- > 1;) {
        const StepRows rows{block.joint(bone + 1), block.joint(bone), block.length(bone)};
        for (std::size_t k = 0; k < registers.count; ++k) step<some>(rows, activity, registers.first[k]);
    }
    for (std::size_t bone = 0; bone < bones; ++bone) {
        const StepRows rows{block.joint(bone), block.joint(bone + 1), block.length(bone)};
        for (std::size_t k = 0; k < registers.count; ++k) step<some>(rows, activity, registers.first[k]);
    }
}

/// The accelerated step, in those of `lanes` where it brings the tip nearer.
HWY_INLINE void reshape(const Block& block, std::size_t i, Mask lanes, Lanes residual, float* scratch) {
    const Lanes reach = load(block.reach() + i);
    const Lanes near =
        hn::Max(hn::Mul(all(0.25f), load(block.row(Row::Tolerance) + i)), hn::Mul(all(1e-6f), reach));
    const Points root = load_points(block.joint(0) + i);
    const Points span = minus(load_points(block.joint(block.bones()) + i), root);
    const std::size_t size = Shape::floats(block.bones());
    const Shape shapes[] = {Shape(scratch), Shape(scratch + size), Shape(scratch + 2 * size),
                            Shape(scratch + 3 * size)};
    Family family = blend_of(span, minus(load_points(block.target() + i), root), reach);
    BestShape best = fit_shape<false>(block, i, family, near, lanes, shapes[0], shapes[1]);
    const Mask missed = hn::Or(hn::Not(best.found), hn::Gt(best.error, hn::Mul(all(0.5f), residual)));
    const Mask tries_other = hn::And(lanes, missed);
    if (!any(tries_other)) {
        lay_shape<false>(block, i, hn::And(lanes, hn::Lt(best.error, residual)), family, best, none(),
                         shapes);
        return;
    }
    const Family around = family_around_longest(block, i, span, family);
    const BestShape other = fit_shape<true>(block, i, around, near, tries_other, shapes[2], shapes[3]);
    const Mask better = hn::And(tries_other, hn::Lt(other.error, best.error));
    best.span = select(better, other.span, best.span);
    best.size = hn::IfThenElse(better, other.size, best.size);
    best.error = hn::IfThenElse(better, other.error, best.error);
    best.second = hn::Or(hn::And(better, other.second), hn::AndNot(better, best.second));
    family.aim = select(better, around.aim, family.aim);
    family.wanted = hn::IfThenElse(better, around.wanted, family.wanted);
    family.turns_longest = around.turns_longest;
    lay_shape<true>(block, i, hn::And(lanes, hn::Lt(best.error, residual)), family, best, better, shapes);
}

/// Where the accelerated step has its turn: with few bones it costs more than the passes, so every other
/// iteration does without.
HWY_INLINE Mask has_its_turn(const Block& block, std::size_t i) {
    if (block.bones() >= few_bones) return hn::Not(none());
    const Lanes iteration = hn::Add(load(block.row(Row::Iterations) + i), all(1.0f));
    const Lanes half = hn::Mul(iteration, all(0.5f));
    return hn::Eq(hn::Floor(half), half);
}

HWY_INLINE void copy_pose(const Block& block, std::size_t i, Mask lanes, bool to_best) {
    for (std::size_t joint = 1; joint <= block.bones(); ++joint) {
        float *const now = block.joint(joint) + i, *const best = block.best(joint) + i;
        copy_points(lanes, to_best ? now : best, to_best ? best : now);
    }
}

/// What of the chains of a register is left to do after an iteration.
struct Verdict {
    Mask goes_on, perturb;
};

/// Counts the iteration and keeps what convergence.hpp keeps.
HWY_INLINE Verdict note(const Block& block, std::size_t i, Mask active, Lanes residual, const Order& order) {
    const auto row = [&](Row which) { return block.row(which) + i; };
    const auto update = [&](Row which, Lanes value) {
        store(hn::IfThenElse(active, value, load(row(which))), row(which));
    };
    const Lanes one = all(1.0f), last = load(row(Row::Last)), nearest = load(row(Row::Nearest)),
                best = load(row(Row::Best)), done = hn::Add(load(row(Row::Iterations)), one);
    const Mask moves = hn::Gt(hn::Abs(hn::Sub(residual, last)), hn::Mul(all(1e-5f), load(block.reach() + i)));
    const Mask progresses = hn::Or(moves, hn::Lt(residual, nearest));
    const Lanes idle = hn::IfThenZeroElse(progresses, hn::Add(load(row(Row::Idle)), one));
    const Mask is_slow = hn::Gt(residual, hn::Mul(all(0.8f), last));
    const Lanes slow = hn::IfThenElseZero(is_slow, hn::Add(load(row(Row::Slow)), one));
    const Mask there = hn::Le(residual, load(row(Row::Tolerance)));
    const Mask nearer = hn::And(active, hn::Lt(residual, best));
    update(Row::Idle, idle), update(Row::Slow, slow);
    update(Row::Nearest, hn::Min(nearest, residual));
    update(Row::Last, residual), update(Row::Residual, residual), update(Row::Iterations, done);
    store(hn::IfThenElse(nearer, residual, best), row(Row::Best));
    const Mask keeps = order.every ? nearer : hn::AndNot(there, nearer);
    if (any(keeps)) copy_pose(block, i, keeps, true);

    const Mask left = hn::And(active, hn::Lt(done, all(static_cast<float>(order.max_iterations))));
    const Mask stalled = hn::Ge(idle, all(stall_patience));
    const Mask stuck = hn::Or(stalled, hn::Ge(slow, all(slow_patience)));
    const Mask may = hn::Lt(load(row(Row::Perturbations)), all(most_perturbations));
    Verdict verdict;
    verdict.perturb = hn::And(hn::AndNot(there, left), hn::And(stuck, may));
    verdict.goes_on = left;
    if (!order.every) {
        verdict.goes_on = hn::AndNot(hn::AndNot(verdict.perturb, hn::Or(there, stalled)), left);
    }
    return verdict;
}

/// Chains that are done without having arrived go back to their best pose.
HWY_INLINE void restore_best(const Block& block, std::size_t i, Mask done) {
    float* const residual = block.row(Row::Residual) + i;
    const Lanes now = load(residual), best = load(block.row(Row::Best) + i);
    const Mask there = hn::Le(now, load(block.row(Row::Tolerance) + i));
    const Mask worse = hn::AndNot(there, hn::And(done, hn::Lt(best, now)));
    if (!any(worse)) return;
    copy_pose(block, i, worse, false);
    store(hn::IfThenElse(worse, best, now), residual);
}

/// What comes after the passes, for one register.
HWY_INLINE void finish_iteration(const Block& block, std::size_t i, const Order& order, Left& left) {
    const Mask active = active_lanes(block, i);
    Lanes residual = residual_of(block, i);
    const Mask short_of = hn::AndNot(hn::Le(residual, load(block.row(Row::Tolerance) + i)), active);
    if (const Mask turn = hn::And(short_of, has_its_turn(block, i)); any(turn)) {
        reshape(block, i, turn, residual, order.shapes);
        residual = residual_of(block, i);
    }
    const Verdict verdict = note(block, i, active, residual, order);
    restore_best(block, i, hn::AndNot(verdict.goes_on, active));
    const auto code = [](Activity value) { return all(static_cast<float>(value)); };
    const Lanes goes_on = hn::IfThenElse(verdict.perturb, code(Activity::Perturb), code(Activity::Active));
    float* const activity = block.row(Row::Activity) + i;
    store(hn::IfThenElse(active, hn::IfThenElseZero(verdict.goes_on, goes_on), load(activity)), activity);
    left.active += hn::CountTrue(Floats(), verdict.goes_on);
    left.perturb = left.perturb || any(verdict.perturb);
}

Left iterate(const Block& block, std::size_t lanes, const Order& order) {
    Left left;
    for (int iteration = 0; iteration < order.iterations && !left.perturb; ++iteration) {
        const Registers registers = active_registers(block, lanes);
        left.active = 0;
        if (registers.count == 0) break;
        if (registers.whole) {
            reach_both_ways<false>(block, registers);
        } else {
            reach_both_ways<true>(block, registers);
        }
        for (std::size_t k = 0; k < registers.count; ++k) {
            finish_iteration(block, registers.first[k], order, left);
        }
    }
    return left;
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::ik::detail {
namespace {
HWY_EXPORT(iterate);
}

Iterate* iterate_with(std::int64_t target) noexcept {
#if HWY_TARGETS == HWY_STATIC_TARGET
    static_cast<void>(target);
    return HWY_STATIC_DISPATCH(iterate);
#else
    hwy::ChosenTarget chosen;
    chosen.Update(target);
    return HWY_DISPATCH_TABLE(iterate)[chosen.GetIndex()];
#endif
}

}  // namespace tendril::ik::detail
#endif
