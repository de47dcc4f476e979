// Steps of FABRIK for a whole register of chains, and for the rows of a block. Not installed; it is included
// once for each vector unit.
//
// Every step is the scalar step of math/point.hpp, operation for operation: no fused multiply-add, no
// approximated root. So each lane has the bits that the scalar solver gives. It costs little: while the
// divider works on one register, the other operations are done for the next.
#if defined(TENDRIL_IK_MANY_STEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TENDRIL_IK_MANY_STEP_INL
#undef TENDRIL_IK_MANY_STEP_INL
#else
#define TENDRIL_IK_MANY_STEP_INL
#endif

#include <hwy/highway.h>

#include "ik/batch/block.hpp"
#include "math/point.hpp"

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
        const Vec squared = squared_distance(before, from), least = all(tendril::math::coincidence);
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
    const Vec coincidence = all(tendril::math::coincidence);
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

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#endif
