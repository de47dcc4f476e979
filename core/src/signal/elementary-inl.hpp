// tendril/elementary.hpp for a register of floats, to 3e-7. No operation is fused, so every lane has the same
// bits with every vector unit. Not installed; included once per vector unit.
#if defined(TENDRIL_SIGNAL_ELEMENTARY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TENDRIL_SIGNAL_ELEMENTARY_INL
#undef TENDRIL_SIGNAL_ELEMENTARY_INL
#else
#define TENDRIL_SIGNAL_ELEMENTARY_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tendril::signal::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using Lanes = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

HWY_INLINE Lanes all(float value) {
    return hn::Set(Floats(), value);
}
HWY_INLINE bool any(Mask mask) {
    return !hn::AllFalse(Floats(), mask);
}
HWY_INLINE Lanes times(Lanes a, Lanes b) {
    return hn::Mul(a, b);
}
HWY_INLINE Lanes times(Lanes a, float b) {
    return hn::Mul(a, all(b));
}

/// `... + x^2 * (third + x * fourth)`: a polynomial by its coefficients, lowest power first.
template <class... Rest>
HWY_INLINE Lanes polynomial(Lanes x, float first, Rest... rest) {
    if constexpr (sizeof...(rest) == 0) {
        return all(first);
    } else {
        return hn::Add(all(first), hn::Mul(x, polynomial(x, rest...)));
    }
}

/// Rounds to the nearest whole number; x under 2^22 in magnitude.
HWY_INLINE Lanes rounded(Lanes x) {
    const Lanes rounder = all(12582912.0f);  // 1.5 * 2^23
    return hn::Sub(hn::Add(x, rounder), rounder);
}

/// e^-x for x >= 0; 0 from 87 on.
HWY_INLINE Lanes decay(Lanes x) {
    const Mask in_range = hn::Lt(x, all(87.0f));
    x = hn::IfThenElseZero(in_range, x);
    // e^-x = 2^-k e^-r; ln 2 is subtracted in two parts, and the products of the first with k are exact.
    const Lanes k = rounded(times(x, 1.44269504f));
    const Lanes r = hn::Sub(hn::Sub(x, times(k, 0.693359375f)), times(k, -2.12194440e-4f));
    const Lanes small = polynomial(r, 1.0f, -1.0f, 1.0f / 2, -1.0f / 6, 1.0f / 24, -1.0f / 120, 1.0f / 720);
    const auto exponent = hn::Sub(hn::Set(Ints(), 127), hn::ConvertTo(Ints(), k));
    const Lanes power = hn::BitCast(Floats(), hn::ShiftLeft<23>(exponent));
    return hn::IfThenElseZero(in_range, hn::Mul(small, power));
}

struct SineCosine {
    Lanes sine, cosine;
};
/// Sine and cosine of an angle in full turns, at least 0; from 2^20 turns on it counts as 0.
HWY_INLINE SineCosine sine_cosine(Lanes turns) {
    turns = hn::IfThenElseZero(hn::Lt(turns, all(1048576.0f)), turns);
    const Lanes quarters = rounded(times(turns, 4.0f));
    const Lanes r = times(hn::Sub(turns, times(quarters, 0.25f)), 6.28318531f);  // |r| <= pi / 4
    const Lanes square = hn::Mul(r, r);
    const Lanes sine =
        hn::Mul(r, polynomial(square, 1.0f, -1.0f / 6, 1.0f / 120, -1.0f / 5040, 1.0f / 362880));
    const Lanes cosine = polynomial(square, 1.0f, -1.0f / 2, 1.0f / 24, -1.0f / 720, 1.0f / 40320);
    const auto quarter = hn::ConvertTo(Ints(), quarters);
    const auto one = hn::Set(Ints(), 1), two = hn::Set(Ints(), 2);
    const Mask swapped = hn::RebindMask(Floats(), hn::TestBit(quarter, one));
    // The second bit of the quarter is the sine's sign, the next quarter's the cosine's.
    const auto sign = [&](auto bits) { return hn::BitCast(Floats(), hn::ShiftLeft<30>(hn::And(bits, two))); };
    return {hn::Xor(hn::IfThenElse(swapped, cosine, sine), sign(quarter)),
            hn::Xor(hn::IfThenElse(swapped, sine, cosine), sign(hn::Add(quarter, one)))};
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::signal::detail
HWY_AFTER_NAMESPACE();

#endif
