// The pulls of solve_many, block by block.
//
// Highway compiles this file once for each vector unit: it includes it again and again, each time with
// another HWY_NAMESPACE.
#include "ik/batch/vector.hpp"

// Adds nothing for floats, and some versions do not compile with it as the baseline (-march=native).
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ik/batch/pull.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

#include "ik/batch/step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

/// From the tip, then from the root.
template <bool some>
HWY_INLINE void pull_twice(const Block& block, std::size_t lanes) {
    const std::size_t bones = block.bones();
    const float* const active = block.row(Row::Active);
    put_on_target(block, bones, lanes);
    // Where the root would be drawn to does not matter: it stays.
    for (std::size_t i = bones; i-- > 1;) {
        step<some>({block.joint(i + 1), block.joint(i), block.length(i)}, active, lanes);
    }
    for (std::size_t i = 1; i <= bones; ++i) {
        step<some>({block.joint(i - 1), block.joint(i), block.length(i - 1)}, active, lanes);
    }
}

/// After an iteration: counts it, measures, and lets those rest that are done. How many are not.
HWY_INLINE std::size_t take_stock(const Block& block, std::size_t lanes, const PullOrder& order) {
    const Floats d;
    const Vec one = all(1.0f), most = all(static_cast<float>(order.max_iterations));
    const Vec patience = all(static_cast<float>(stall_patience));
    const float *const tip = block.joint(block.bones()), *const target = block.row(Row::TargetX);
    std::size_t left = 0;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        float *const active = block.row(Row::Active) + i, *const residual = block.row(Row::Residual) + i,
                     *const nearest = block.row(Row::Nearest) + i, *const idle = block.row(Row::Idle) + i,
                     *const count = block.row(Row::Iterations) + i;
        const Mask moved = hn::Gt(load(active), hn::Zero(d));
        const Vec distance = hn::Sqrt(squared_distance(tip + i, target + i)),
                  done = hn::Add(load(count), one);
        const Mask nearer = hn::Lt(distance, load(nearest));
        const Vec waits = hn::IfThenZeroElse(nearer, hn::Add(load(idle), one));
        Mask goes_on = hn::And(moved, hn::Lt(done, most));
        if (!order.every) {
            const Mask arrived = hn::Le(distance, load(block.row(Row::Tolerance) + i));
            goes_on = hn::AndNot(hn::Or(arrived, hn::Ge(waits, patience)), goes_on);
        }
        hn::Store(hn::IfThenElse(moved, distance, load(residual)), d, residual);
        hn::Store(hn::IfThenElse(hn::And(moved, nearer), distance, load(nearest)), d, nearest);
        hn::Store(hn::IfThenElse(moved, waits, load(idle)), d, idle);
        hn::Store(hn::IfThenElse(moved, done, load(count)), d, count);
        hn::Store(hn::IfThenElseZero(goes_on, one), d, active);
        left += hn::CountTrue(d, goes_on);
    }
    return left;
}

std::size_t pull(const Block& block, std::size_t lanes, const PullOrder& order) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < lanes; ++i) left += block.at(Row::Active, i) > 0.0f ? 1 : 0;
    for (int iteration = 0; iteration < order.iterations && left > 0; ++iteration) {
        if (left == lanes) {  // what moves in unused lanes harms nobody
            pull_twice<false>(block, lanes);
        } else {
            pull_twice<true>(block, lanes);
        }
        left = take_stock(block, lanes, order);
    }
    return left;
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::ik::detail {
namespace {
HWY_EXPORT(pull);
}

Pull* pull_with(std::int64_t target) noexcept {
#if HWY_TARGETS == HWY_STATIC_TARGET
    static_cast<void>(target);
    return HWY_STATIC_DISPATCH(pull);
#else
    hwy::ChosenTarget chosen;
    chosen.Update(target);
    return HWY_DISPATCH_TABLE(pull)[chosen.GetIndex()];
#endif
}

}  // namespace tendril::ik::detail
#endif
