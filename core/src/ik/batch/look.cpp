// What solve_many does before the first pull: which chains can be pulled at all, and which must be laid
// first.
//
// Highway compiles this file once for each vector unit: it includes it again and again, each time with
// another HWY_NAMESPACE.
#include "ik/batch/vector.hpp"
#include "tendril/chain/segment.hpp"

// Adds nothing for floats, and some versions do not compile with it as the baseline (-march=native).
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ik/batch/look.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

#include "ik/batch/step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

constexpr float far_out =
    1e3f;  ///< metres: from there on floats stand too far apart for the invariant of chain.hpp
// Of what a bone may be off: between these two a float cannot tell, for rounding is a three-hundredth of it.
constexpr float surely_fits = 0.95f, surely_loose = 1.05f;

HWY_INLINE Vec largest(const float* point, Vec so_far) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        so_far = hn::Max(so_far, hn::Abs(load(point + axis * block_lanes)));
    }
    return so_far;
}
HWY_INLINE Mask starts(const Block& block, std::size_t i, Start start) {
    return hn::Eq(load(block.row(Row::Start) + i), all(static_cast<float>(start)));
}

/// The coordinate of a register of chains that is furthest out, in metres.
HWY_INLINE Vec furthest(const Block& block, std::size_t i) {
    Vec far = hn::Zero(Floats());
    for (std::size_t joint = 0; joint <= block.bones(); ++joint) far = largest(block.joint(joint) + i, far);
    return far;
}

/// By how much a bone is off its length, and how much lay_to_lengths (prepare.cpp) lets pass.
HWY_INLINE void compare(const Block& block, std::size_t bone, std::size_t i, bool is_far, Vec& off,
                        Vec& allowed) {
    const float *const from = block.joint(bone) + i, *const to = block.joint(bone + 1) + i;
    const Vec size = load(block.length(bone) + i);
    off = hn::Abs(hn::Sub(hn::Sqrt(squared_distance(from, to)), size));
    allowed = hn::Mul(hn::Max(all(1.0f), size), all(1e-4f));
    if (!is_far) return;
    const Vec ends = largest(to, largest(from, hn::Zero(Floats())));
    const Mask beyond = hn::Gt(ends, all(far_out));
    allowed = hn::Add(allowed, hn::IfThenElseZero(beyond, hn::Mul(ends, all(FLT_EPSILON))));
}

/// Whether the bones of a register of chains are at their lengths: adds to `careful` where that is hard to
/// tell or to mend.
HWY_INLINE Mask find_loose(const Block& block, std::size_t i, bool is_far, Mask& careful) {
    Mask loose = none();
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        Vec off, allowed;
        compare(block, bone, i, is_far, off, allowed);
        loose = hn::Or(loose, hn::Gt(off, hn::Mul(allowed, all(surely_loose))));
        const Mask unclear = hn::AndNot(loose, hn::Ge(off, hn::Mul(allowed, all(surely_fits))));
        const Vec squared = squared_distance(block.joint(bone) + i, block.joint(bone + 1) + i);
        const Mask blind = hn::And(loose, hn::Lt(squared, all(tendril::math::coincidence)));
        careful = hn::Or(careful, hn::Or(unclear, blind));
    }
    return loose;
}

/// Writes Row::Start for one register of chains, and Active where some bone is loose; true if there is one.
/// All thresholds leave room for the rounding of floats: what is nearer than that is left to the scalar code.
HWY_INLINE bool sort_out(const Block& block, std::size_t i) {
    const Floats d;
    const Vec reach = load(block.row(Row::Reach) + i), longest = load(block.row(Row::Longest) + i);
    const Vec rim = hn::Mul(reach, all(1e-5f));
    const Vec distance = hn::Sqrt(squared_distance(block.joint(0) + i, block.row(Row::TargetX) + i));
    // So far out that no joint comes to coincide with the target.
    const Mask beyond = hn::Gt(distance, hn::Add(hn::Add(reach, rim), all(1e-3f)));
    const Mask within = hn::Lt(distance, hn::Sub(reach, rim));
    const Mask unfolded = hn::Gt(distance, hn::Add(hn::Sub(hn::Add(longest, longest), reach), rim));
    const Vec far = furthest(block, i);
    const bool is_far = !hn::AllFalse(d, hn::Gt(far, all(far_out)));
    Mask careful = hn::Not(hn::And(within, unfolded)), valid = hn::Le(far, all(max_magnitude));
    const Mask loose = find_loose(block, i, is_far, careful);
    for (std::size_t axis = 0; axis < 3; ++axis) {  // false for what is not a number
        const Vec coordinate = load(block.row(Row::TargetX) + axis * block_lanes + i);
        valid = hn::And(valid, hn::Le(hn::Abs(coordinate), all(max_magnitude)));
    }

    Vec start = all(static_cast<float>(Start::Plain));
    start = hn::IfThenElse(careful, all(static_cast<float>(Start::Careful)), start);
    start = hn::IfThenElse(beyond, all(static_cast<float>(Start::Straight)), start);
    start = hn::IfThenElse(valid, start, all(static_cast<float>(Start::Invalid)));
    hn::Store(start, d, block.row(Row::Start) + i);
    return !hn::AllFalse(d, hn::And(loose, starts(block, i, Start::Plain)));
}

/// From the first loose bone on, in the lanes that are plain: what lay_to_lengths does.
HWY_INLINE void lay_loose(const Block& block, std::size_t lanes) {
    const Floats d;
    float* const active = block.row(Row::Active);
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
            Vec off, allowed;
            compare(block, bone, i, true, off, allowed);
            const Mask fails = hn::Gt(off, hn::Mul(allowed, all(surely_loose)));
            const Mask lay = hn::And(fails, starts(block, i, Start::Plain));
            hn::Store(hn::IfThenElse(lay, all(1.0f), load(active + i)), d, active + i);
        }
        const float* const before = bone > 0 ? block.joint(bone - 1) : nullptr;
        step<true>({block.joint(bone), block.joint(bone + 1), block.length(bone), before}, active, lanes);
    }
}

/// Every joint straight towards the target from where the one before has come to lie, so that the roundings
/// of many joints do not add up to a bend.
HWY_INLINE void lay_straight(const Block& block, std::size_t lanes) {
    const Floats d;
    float* const active = block.row(Row::Active);
    Mask any = none();
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const Mask straight = starts(block, i, Start::Straight);
        hn::Store(hn::IfThenElseZero(straight, all(1.0f)), d, active + i);
        any = hn::Or(any, straight);
    }
    if (hn::AllFalse(d, any)) return;
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        put_on_target(block, bone + 1, lanes);
        step<true>({block.joint(bone), block.joint(bone + 1), block.length(bone)}, active, lanes);
    }
}

/// Whether all joints of a chain may lie on one line with its target. Where they do, to 1e-5 of the reach
/// (kick.cpp), the product of no arm with the target's arm is over twice that and what rounding adds.
HWY_INLINE Mask may_be_trapped(const Block& block, std::size_t i) {
    const Floats d;
    const float *const root = block.joint(0) + i, *const target = block.row(Row::TargetX) + i;
    const Vec rx = load(root), ry = load(root + block_lanes), rz = load(root + 2 * block_lanes);
    const Vec tx = hn::Sub(load(target), rx), ty = hn::Sub(load(target + block_lanes), ry),
              tz = hn::Sub(load(target + 2 * block_lanes), rz);
    Vec most = hn::Zero(d);
    for (std::size_t joint = 1; joint <= block.bones(); ++joint) {
        const float* const at = block.joint(joint) + i;
        const Vec x = hn::Sub(load(at), rx), y = hn::Sub(load(at + block_lanes), ry),
                  z = hn::Sub(load(at + 2 * block_lanes), rz);
        const Vec cx = hn::Sub(hn::Mul(y, tz), hn::Mul(z, ty)), cy = hn::Sub(hn::Mul(z, tx), hn::Mul(x, tz)),
                  cz = hn::Sub(hn::Mul(x, ty), hn::Mul(y, tx));
        most = hn::Max(most, squares(cx, cy, cz));
    }
    const Vec reach = load(block.row(Row::Reach) + i);
    return hn::Le(hn::Sqrt(most), hn::Mul(hn::Mul(reach, reach), all(4e-5f)));
}

std::size_t look(const Block& block, std::size_t lanes, bool every) {
    const Floats d;
    float* const active = block.row(Row::Active);
    bool loose = false;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        hn::Store(hn::Zero(d), d, active + i);
        loose |= sort_out(block, i);
    }
    if (loose) lay_loose(block, lanes);
    lay_straight(block, lanes);
    std::size_t left = 0;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const Mask plain = starts(block, i, Start::Plain), trapped = hn::And(plain, may_be_trapped(block, i));
        const Vec start = load(block.row(Row::Start) + i);
        hn::Store(hn::IfThenElse(trapped, all(static_cast<float>(Start::Careful)), start), d,
                  block.row(Row::Start) + i);
        const Vec distance =
            hn::Sqrt(squared_distance(block.joint(block.bones()) + i, block.row(Row::TargetX) + i));
        hn::Store(distance, d, block.row(Row::Residual) + i);
        hn::Store(distance, d, block.row(Row::Nearest) + i);
        hn::Store(hn::Zero(d), d, block.row(Row::Idle) + i);
        hn::Store(hn::Zero(d), d, block.row(Row::Iterations) + i);
        Mask goes_on = hn::AndNot(trapped, plain);
        if (!every) {
            goes_on = hn::AndNot(hn::Le(distance, load(block.row(Row::Tolerance) + i)), goes_on);
        }
        hn::Store(hn::IfThenElseZero(goes_on, all(1.0f)), d, active + i);
        left += hn::CountTrue(d, goes_on);
    }
    return left;
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::ik::detail {
namespace {
HWY_EXPORT(look);
}

Look* look_with(std::int64_t target) noexcept {
#if HWY_TARGETS == HWY_STATIC_TARGET
    static_cast<void>(target);
    return HWY_STATIC_DISPATCH(look);
#else
    hwy::ChosenTarget chosen;
    chosen.Update(target);
    return HWY_DISPATCH_TABLE(look)[chosen.GetIndex()];
#endif
}

}  // namespace tendril::ik::detail
#endif
