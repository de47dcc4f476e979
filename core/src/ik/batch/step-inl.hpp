// Points of a register of chains, and the step of FABRIK for the rows of a block. Not installed; included
// once per vector unit.
//
// Every operation is the scalar one of math/point.hpp, in the same order: no fused multiply-add, no
// approximate root. So each lane has the same bits as the scalar solver. This costs little: while the divider
// works on one register, the other operations run for the next.
#if defined(TENDRIL_IK_BATCH_STEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TENDRIL_IK_BATCH_STEP_INL
#undef TENDRIL_IK_BATCH_STEP_INL
#else
#define TENDRIL_IK_BATCH_STEP_INL
#endif

#include <hwy/highway.h>

#include <bit>

#include "ik/batch/block.hpp"
#include "math/point.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;  // so that whole registers fill a block
using Lanes = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

HWY_INLINE Lanes load(const float* from) {
    return hn::Load(Floats(), from);
}
HWY_INLINE void store(Lanes value, float* to) {
    hn::Store(value, Floats(), to);
}
HWY_INLINE Lanes all(float value) {
    return hn::Set(Floats(), value);
}
HWY_INLINE Lanes zero() {
    return hn::Zero(Floats());
}
HWY_INLINE Mask none() {
    return hn::MaskFromVec(zero());
}
HWY_INLINE bool any(Mask mask) {
    return !hn::AllFalse(Floats(), mask);
}
template <class Enum>
HWY_INLINE Mask equals(const float* row, Enum value) {
    return hn::Eq(load(row), all(static_cast<float>(value)));
}

/// Calls `call` with each lane in the mask.
template <class Call>
HWY_INLINE void for_each_lane(Mask lanes, Call call) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Floats(), lanes, bytes);
    std::uint32_t bits = bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
    for (; bits != 0; bits &= bits - 1) call(static_cast<std::size_t>(std::countr_zero(bits)));
}

/// One point or direction per chain of a register.
struct Points {
    Lanes x, y, z;
};
HWY_INLINE Points load_points(const float* rows) {
    return {load(rows), load(rows + block_lanes), load(rows + 2 * block_lanes)};
}
HWY_INLINE void store_points(const Points& p, float* rows) {
    store(p.x, rows), store(p.y, rows + block_lanes), store(p.z, rows + 2 * block_lanes);
}
HWY_INLINE Points select(Mask mask, const Points& yes, const Points& no) {
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
            hn::IfThenElse(mask, yes.z, no.z)};
}
HWY_INLINE Points plus(const Points& a, const Points& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Points minus(const Points& a, const Points& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Points times(const Points& a, Lanes by) {
    return {hn::Mul(a.x, by), hn::Mul(a.y, by), hn::Mul(a.z, by)};
}
HWY_INLINE Points moved(const Points& origin, const Points& direction, Lanes by) {
    return plus(origin, times(direction, by));
}
HWY_INLINE Lanes dot(const Points& a, const Points& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Points cross(const Points& a, const Points& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE Lanes length(const Points& a) {
    return hn::Sqrt(dot(a, a));
}
HWY_INLINE Lanes squared_distance(const float* from, const float* to) {
    const Points apart = minus(load_points(to), load_points(from));
    return dot(apart, apart);
}
HWY_INLINE Lanes residual_of(const Block& block, std::size_t i) {
    return hn::Sqrt(squared_distance(block.joint(block.bones()) + i, block.target() + i));
}

/// Handles coinciding joints: continues in the direction of the previous bone, or +X if that has none.
/// `before` is null for the first bone.
HWY_INLINE Points straight_on(const float* before, const Points& from, Mask close, Lanes size,
                              const Points& otherwise) {
    Points along{all(1.0f), zero(), zero()};
    if (before != nullptr) {
        const Points apart = minus(from, load_points(before));
        const Lanes squared = dot(apart, apart), least = all(math::coincidence);
        const Lanes inverse = hn::Div(all(1.0f), hn::Sqrt(hn::Max(squared, least)));
        along = select(hn::Ge(squared, least), times(apart, inverse), along);
    }
    return select(close, moved(from, along, size), otherwise);
}

/// The rows that a step reads and writes.
struct StepRows {
    const float* from;    ///< the joint already placed
    float* to;            ///< the joint to place
    const float* length;  ///< length of the bone between them
    const float* before = nullptr;
};

/// Steps in all lanes of a register, or (`some`) only in active ones.
template <bool some>
HWY_INLINE void step(const StepRows& rows, const float* activity, std::size_t i) {
    const Lanes coincidence = all(math::coincidence);
    const Points from = load_points(rows.from + i), old = load_points(rows.to + i);
    const Points apart = minus(old, from);
    const Lanes squared = dot(apart, apart), size = load(rows.length + i);
    const Lanes scale = hn::Div(size, hn::Sqrt(hn::Max(squared, coincidence)));
    Points to = moved(from, apart, scale);
    const Mask close = hn::Lt(squared, coincidence);
    if (HWY_UNLIKELY(any(close))) {
        to = straight_on(rows.before ? rows.before + i : nullptr, from, close, size, to);
    }
    if constexpr (some) to = select(equals(activity + i, Activity::Active), to, old);
    store_points(to, rows.to + i);
}

HWY_INLINE void copy_points(Mask lanes, const float* from, float* to) {
    for (std::size_t k = 0; k < 3; ++k) {
        hn::BlendedStore(load(from + k * block_lanes), lanes, Floats(), to + k * block_lanes);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#endif
