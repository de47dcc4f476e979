// The pulls of solve_many. This file is compiled once for each vector unit: Highway includes it again and
// again, each time with another HWY_NAMESPACE.
//
// Every step is the scalar step of pull.hpp, operation for operation: no fused multiply-add, no approximated
// root. So each lane has the bits that the scalar solver gives. It costs little: while the divider works on
// one register, the other operations are done for the next.
#include "ik/many_vector.hpp"

#include <array>
#include <cstdint>

#include "chain/pull.hpp"
#include "tendril/chain/segment.hpp"
#include "tendril/ik/many.hpp"

// Adds nothing for floats, and some versions do not compile with it as the baseline (-march=native).
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ik/many_vector.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;  // so that whole registers fill a block
using Vec = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

HWY_INLINE Vec load(const float* from) {
    return hn::Load(Floats(), from);
}
HWY_INLINE Vec all(float value) {
    return hn::Set(Floats(), value);
}
HWY_INLINE Mask none() {
    return hn::MaskFromVec(hn::Zero(Floats()));
}
HWY_INLINE Vec squares(Vec x, Vec y, Vec z) {
    return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}
/// `from` and `to` are the rows of points.
HWY_INLINE Vec squared_distance(const float* from, const float* to) {
    return squares(hn::Sub(load(to), load(from)), hn::Sub(load(to + block_lanes), load(from + block_lanes)),
                   hn::Sub(load(to + 2 * block_lanes), load(from + 2 * block_lanes)));
}

/// Where there is no direction between two joints: that of the bone before, or +X where that has none either.
/// `before` is null where there is none.
HWY_INLINE void straight_on(const float* before, const float* from, Mask close, Vec size, Vec& px, Vec& py,
                            Vec& pz) {
    const Vec ax = load(from), ay = load(from + block_lanes), az = load(from + 2 * block_lanes);
    Vec x = all(1.0f), y = hn::Zero(Floats()), z = y;
    if (before != nullptr) {
        const Vec squared = squared_distance(before, from), least = all(tendril::detail::coincidence);
        const Mask shows = hn::Ge(squared, least);
        const Vec inverse = hn::Div(all(1.0f), hn::Sqrt(hn::Max(squared, least)));
        x = hn::IfThenElse(shows, hn::Mul(hn::Sub(ax, load(before)), inverse), x);
        y = hn::IfThenElse(shows, hn::Mul(hn::Sub(ay, load(before + block_lanes)), inverse), y);
        z = hn::IfThenElse(shows, hn::Mul(hn::Sub(az, load(before + 2 * block_lanes)), inverse), z);
    }
    px = hn::IfThenElse(close, hn::Add(ax, hn::Mul(x, size)), px);
    py = hn::IfThenElse(close, hn::Add(ay, hn::Mul(y, size)), py);
    pz = hn::IfThenElse(close, hn::Add(az, hn::Mul(z, size)), pz);
}

/// The rows that a step reads and writes.
struct StepRows {
    const float* from;    ///< the joint that is placed already
    float* to;            ///< the one that is drawn to it
    const float* length;  ///< of the bone between them
    const float* before = nullptr;
};

/// In the active lanes, or in all of them.
template <bool some>
HWY_INLINE void step(const StepRows& rows, const float* active, std::size_t lanes) {
    const Floats d;
    const Vec coincidence = all(tendril::detail::coincidence);
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const float* const from = rows.from + i;
        float* const to = rows.to + i;
        const Vec ax = load(from), ay = load(from + block_lanes), az = load(from + 2 * block_lanes);
        const Vec ox = load(to), oy = load(to + block_lanes), oz = load(to + 2 * block_lanes);
        const Vec x = hn::Sub(ox, ax), y = hn::Sub(oy, ay), z = hn::Sub(oz, az);
        const Vec squared = squares(x, y, z), size = load(rows.length + i);
        const Vec scale = hn::Div(size, hn::Sqrt(hn::Max(squared, coincidence)));
        Vec px = hn::Add(ax, hn::Mul(x, scale)), py = hn::Add(ay, hn::Mul(y, scale)),
            pz = hn::Add(az, hn::Mul(z, scale));
        const Mask close = hn::Lt(squared, coincidence);
        if (HWY_UNLIKELY(!hn::AllFalse(d, close))) {
            straight_on(rows.before ? rows.before + i : nullptr, from, close, size, px, py, pz);
        }
        if constexpr (some) {
            const Mask moves = hn::Gt(load(active + i), hn::Zero(d));
            px = hn::IfThenElse(moves, px, ox);
            py = hn::IfThenElse(moves, py, oy);
            pz = hn::IfThenElse(moves, pz, oz);
        }
        hn::Store(px, d, to);
        hn::Store(py, d, to + block_lanes);
        hn::Store(pz, d, to + 2 * block_lanes);
    }
}

/// In the active lanes.
HWY_INLINE void put_on_target(const Block& block, std::size_t joint, std::size_t lanes) {
    const Floats d;
    const float *const target = block.row(Row::TargetX), *const active = block.row(Row::Active);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float* const to = block.joint(joint) + axis * block_lanes;
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
            const Mask moves = hn::Gt(load(active + i), hn::Zero(d));
            hn::Store(hn::IfThenElse(moves, load(target + axis * block_lanes + i), load(to + i)), d, to + i);
        }
    }
}

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

HWY_INLINE Vec largest(const float* point, Vec so_far) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        so_far = hn::Max(so_far, hn::Abs(load(point + axis * block_lanes)));
    }
    return so_far;
}
HWY_INLINE Mask starts(const Block& block, std::size_t i, Start start) {
    return hn::Eq(load(block.row(Row::Start) + i), all(static_cast<float>(start)));
}

/// How far a bone's length is off, as a part of what lay_to_lengths (prepare.cpp) lets pass.
HWY_INLINE Vec looseness(const Block& block, std::size_t bone, std::size_t i) {
    const float *const from = block.joint(bone) + i, *const to = block.joint(bone + 1) + i;
    const Vec size = load(block.length(bone) + i), ends = largest(to, largest(from, hn::Zero(Floats())));
    const Vec spacing = hn::IfThenElseZero(hn::Gt(ends, all(1e3f)), hn::Mul(ends, all(FLT_EPSILON)));
    const Vec allowed = hn::Add(hn::Mul(hn::Max(all(1.0f), size), all(1e-4f)), spacing);
    return hn::Div(hn::Abs(hn::Sub(hn::Sqrt(squared_distance(from, to)), size)), allowed);
}
// Between these two a float cannot tell: its rounding is a three-hundredth of what is allowed.
constexpr float surely_fits = 0.95f, surely_loose = 1.05f;

/// Whether the bones of a register of chains are at their lengths: adds to `careful` where that is hard to
/// tell or to mend.
HWY_INLINE Mask find_loose(const Block& block, std::size_t i, Mask& careful) {
    Mask loose = none();
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        const Vec off = looseness(block, bone, i);
        loose = hn::Or(loose, hn::Gt(off, all(surely_loose)));
        const Mask unclear = hn::And(hn::Ge(off, all(surely_fits)), hn::Le(off, all(surely_loose)));
        const Vec squared = squared_distance(block.joint(bone) + i, block.joint(bone + 1) + i);
        const Mask blind = hn::And(loose, hn::Lt(squared, all(tendril::detail::coincidence)));
        careful = hn::Or(careful, hn::Or(unclear, blind));
    }
    return loose;
}

/// False for what is not a number.
HWY_INLINE Mask in_range(const Block& block, std::size_t i) {
    const Vec limit = all(max_magnitude);
    const float* const target = block.row(Row::TargetX) + i;
    Vec far = hn::Zero(Floats());
    for (std::size_t joint = 0; joint <= block.bones(); ++joint) far = largest(block.joint(joint) + i, far);
    Mask valid = hn::Le(far, limit);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        valid = hn::And(valid, hn::Le(hn::Abs(load(target + axis * block_lanes)), limit));
    }
    return valid;
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
    Mask careful = hn::Not(hn::And(within, unfolded));
    const Mask loose = find_loose(block, i, careful);

    Vec start = all(static_cast<float>(Start::Plain));
    start = hn::IfThenElse(careful, all(static_cast<float>(Start::Careful)), start);
    start = hn::IfThenElse(beyond, all(static_cast<float>(Start::Straight)), start);
    start = hn::IfThenElse(in_range(block, i), start, all(static_cast<float>(Start::Invalid)));
    hn::Store(start, d, block.row(Row::Start) + i);
    return !hn::AllFalse(d, hn::And(loose, starts(block, i, Start::Plain)));
}

/// From the first loose bone on, in the lanes that are plain: what lay_to_lengths does.
HWY_INLINE void lay_loose(const Block& block, std::size_t lanes) {
    const Floats d;
    float* const active = block.row(Row::Active);
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
            const Mask fails = hn::Gt(looseness(block, bone, i), all(surely_loose));
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
namespace tendril::ik {
namespace detail {
namespace {

HWY_EXPORT(look);
HWY_EXPORT(pull);

#if HWY_TARGETS == HWY_STATIC_TARGET
VectorUnit unit_for(std::int64_t) noexcept {
    return {HWY_STATIC_DISPATCH(look), HWY_STATIC_DISPATCH(pull)};
}
#else
VectorUnit unit_for(std::int64_t target) noexcept {
    hwy::ChosenTarget chosen;
    chosen.Update(target);
    return {HWY_DISPATCH_TABLE(look)[chosen.GetIndex()], HWY_DISPATCH_TABLE(pull)[chosen.GetIndex()]};
}
#endif

/// Those that both the machine has and this file was compiled for.
struct Units {
    std::array<VectorUnit, 16> units{};
    std::array<std::string_view, 16> names{};
    std::size_t count = 0;

    Units() noexcept {
        // A lower bit is a better target.
        std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
        if (targets == 0) targets = HWY_STATIC_TARGET;
        for (; targets != 0 && count < names.size(); targets &= targets - 1) {
            const std::int64_t target = targets & -targets;
            names[count] = hwy::TargetName(target);
            units[count++] = unit_for(target);
        }
    }
};

const Units& units() noexcept {
    static const Units found;
    return found;
}

}  // namespace

const VectorUnit* vector_unit_named(std::string_view name) noexcept {
    const Units& all = units();
    for (std::size_t i = 0; i < all.count; ++i) {
        if (all.names[i] == name) return &all.units[i];
    }
    return nullptr;
}

}  // namespace detail

std::span<const std::string_view> vector_units() noexcept {
    const detail::Units& all = detail::units();
    return {all.names.data(), all.count};
}

}  // namespace tendril::ik
#endif
