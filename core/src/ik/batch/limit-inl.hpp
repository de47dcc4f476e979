// Quaternions of a register of chains, and the clamp of a joint to its limit. Not installed; included once
// per vector unit.
#if defined(TENDRIL_IK_BATCH_LIMIT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TENDRIL_IK_BATCH_LIMIT_INL
#undef TENDRIL_IK_BATCH_LIMIT_INL
#else
#define TENDRIL_IK_BATCH_LIMIT_INL
#endif

#include "ik/batch/limits.hpp"
#include "ik/batch/step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

struct Rotations {
    Lanes w;
    Points v;
};
HWY_INLINE Rotations select(Mask mask, const Rotations& yes, const Rotations& no) {
    return {hn::IfThenElse(mask, yes.w, no.w), select(mask, yes.v, no.v)};
}
HWY_INLINE Points all(const glm::vec3& p) {
    return {all(p.x), all(p.y), all(p.z)};
}
HWY_INLINE Rotations conjugate(const Rotations& q) {
    return {q.w, {hn::Neg(q.v.x), hn::Neg(q.v.y), hn::Neg(q.v.z)}};
}
/// Applies `b` first, then `a`.
HWY_INLINE Rotations compose(const Rotations& a, const Rotations& b) {
    return {hn::Sub(hn::Mul(a.w, b.w), dot(a.v, b.v)),
            plus(plus(times(b.v, a.w), times(a.v, b.w)), cross(a.v, b.v))};
}
HWY_INLINE Rotations normalized(const Rotations& q) {
    const Lanes squared = hn::Add(hn::Mul(q.w, q.w), dot(q.v, q.v));
    const Lanes scale = hn::Div(all(1.0f), hn::Sqrt(squared));
    return {hn::Mul(q.w, scale), times(q.v, scale)};
}
HWY_INLINE Points rotated(const Rotations& q, const Points& p) {
    const Points t = cross(q.v, p), twice = plus(t, t);
    return plus(plus(p, times(twice, q.w)), cross(q.v, twice));
}

/// sin(x) / x from x^2, for x from 0 to pi/2, to 1e-7: the Taylor series.
HWY_INLINE Lanes sinc_of(Lanes squared) {
    Lanes sum = all(-1.0f / 39916800.0f);
    for (const float factor : {1.0f / 362880.0f, -1.0f / 5040.0f, 1.0f / 120.0f, -1.0f / 6.0f, 1.0f}) {
        sum = hn::Add(hn::Mul(sum, squared), all(factor));
    }
    return sum;
}
HWY_INLINE Lanes cosine_of(Lanes sine) {
    return hn::Sqrt(hn::Max(hn::Sub(all(1.0f), hn::Mul(sine, sine)), zero()));
}

/// The bounds that a joint is at.
struct BoundState {
    Points outward;      ///< axis of a swing on the rim; zero inside
    Lanes upper, lower;  ///< 1 if the hinge or twist is at this end of its range
    BoundState() : outward{zero(), zero(), zero()}, upper(zero()), lower(zero()) {}
};

/// Cosine and sine of a half-angle. The cosine is not negative.
struct HalfAngles {
    Lanes cosine, sine;
};

HWY_INLINE HalfAngles clamp(const HalfRange& range, const HalfAngles& half, BoundState& bound_state) {
    if (range.whole) return half;
    const Lanes sine = hn::Min(hn::Max(half.sine, all(range.min)), all(range.max));
    constexpr float near = 5e-5f;  // half of at_bound
    bound_state.upper = hn::IfThenElseZero(hn::Ge(sine, all(range.max - near)), all(1.0f));
    bound_state.lower = hn::IfThenElseZero(hn::Le(sine, all(range.min + near)), all(1.0f));
    const Mask stays = hn::Eq(sine, half.sine);
    if (hn::AllTrue(Floats(), stays)) return half;
    return {hn::IfThenElse(stays, half.cosine, cosine_of(sine)), sine};
}

/// The twist of a unit quaternion about an axis: `along` is its vector's component along the axis.
HWY_INLINE HalfAngles twist_of(Lanes w, Lanes along) {
    const Lanes size = hn::Sqrt(hn::Add(hn::Mul(w, w), hn::Mul(along, along)));
    const Mask shows = hn::Gt(size, all(1e-6f));
    const Lanes scale = hn::CopySign(hn::Div(all(1.0f), size), w);  // the shorter way round
    return {hn::IfThenElse(shows, hn::Abs(hn::Mul(w, scale)), all(1.0f)),
            hn::IfThenElseZero(shows, hn::Mul(along, scale))};
}

/// A swing: the cosine of its half-angle, and the vector of its quaternion, perpendicular to the bone.
struct Swings {
    Lanes cosine, up, left;
};

/// Clamps to the cone: along the swing's own direction, to the rim. Compares sines of half-angles, so no
/// angle is measured.
HWY_INLINE Swings clamp(const BatchLimit& limit, const Swings& swing, BoundState& bound_state) {
    const Mask upward = hn::Ge(swing.up, zero()), leftward = hn::Ge(swing.left, zero());
    const Lanes a = hn::IfThenElse(upward, all(limit.up), all(limit.down)),
                b = hn::IfThenElse(leftward, all(limit.left), all(limit.right));
    const Lanes up2 = hn::Mul(swing.up, swing.up), left2 = hn::Mul(swing.left, swing.left);
    // Relative to the rim in that direction, squared, but with the sine instead of the angle.
    const Lanes outside = hn::Add(hn::Mul(up2, a), hn::Mul(left2, b));
    constexpr float pi = 3.14159265f;
    const Mask surely_inside = hn::Lt(hn::Mul(outside, all(pi * pi)), all(1.0f));
    if (hn::AllTrue(Floats(), surely_inside)) return swing;
    // The rim is at the angle sine / sqrt(outside); scale is the sine of half that angle over the swing's.
    const Lanes squared = hn::Add(up2, left2);
    const Lanes inverse = hn::Div(all(0.25f), hn::Max(outside, all(1e-20f)));
    const Lanes scale = hn::Mul(sinc_of(hn::Mul(squared, inverse)), hn::Sqrt(inverse));
    const Mask beyond = hn::AndNot(surely_inside, hn::Lt(scale, all(1.0f)));
    const Lanes rim_cosine =
        hn::Sqrt(hn::Max(hn::Sub(all(1.0f), hn::Mul(hn::Mul(scale, scale), squared)), zero()));
    const Swings clamped{hn::IfThenElse(beyond, rim_cosine, swing.cosine),
                         hn::IfThenElse(beyond, hn::Mul(swing.up, scale), swing.up),
                         hn::IfThenElse(beyond, hn::Mul(swing.left, scale), swing.left)};
    const Mask on_rim = hn::AndNot(surely_inside, hn::Lt(scale, all(1.0f + 1e-4f)));
    if (!any(on_rim)) return clamped;
    // Outward is the normal of the ellipse.
    const Lanes nu = hn::Mul(swing.up, a), nl = hn::Mul(swing.left, b);
    const Lanes size = hn::Add(hn::Mul(nu, nu), hn::Mul(nl, nl));
    const Lanes unit = hn::Div(all(1.0f), hn::Sqrt(hn::Max(size, all(1e-20f))));
    bound_state.outward =
        times(plus(times(all(limit.axis), nu), times(all(limit.side), nl)), hn::IfThenElseZero(on_rim, unit));
    return clamped;
}

/// Clamps the rotation of a bone relative to its parent, a unit quaternion. For a cone it is split as in
/// LimitedJoint: first the twist about the bone, then the swing.
HWY_INLINE Rotations clamp(const BatchLimit& limit, const Rotations& turn, BoundState& bound_state) {
    if (limit.kind == BatchLimit::Kind::Free) return turn;
    const Lanes up = dot(turn.v, all(limit.axis));
    if (limit.kind == BatchLimit::Kind::Hinge) {
        const HalfAngles half = clamp(limit.range, twist_of(turn.w, up), bound_state);
        return {half.cosine, times(all(limit.axis), half.sine)};
    }
    const Lanes along = dot(turn.v, all(limit.bone)), left = dot(turn.v, all(limit.side));
    const HalfAngles twist = twist_of(turn.w, along);
    // The rotation after the inverse twist, with the sign chosen so that w is positive.
    const Lanes sign = hn::CopySign(all(1.0f), turn.w);
    const Lanes c = hn::Mul(twist.cosine, sign), s = hn::Mul(twist.sine, sign);
    const Lanes cosine = hn::Add(hn::Mul(turn.w, c), hn::Mul(along, s));
    const Swings from{cosine, hn::Add(hn::Mul(up, c), hn::Mul(left, s)),
                      hn::Sub(hn::Mul(left, c), hn::Mul(up, s))};
    const Swings swing = clamp(limit, from, bound_state);
    const HalfAngles to = clamp(limit.range, twist, bound_state);
    const Points bone = times(all(limit.bone), hn::Mul(swing.cosine, to.sine)),
                 axis = times(all(limit.axis),
                              hn::Sub(hn::Mul(swing.up, to.cosine), hn::Mul(swing.left, to.sine))),
                 side = times(all(limit.side),
                              hn::Add(hn::Mul(swing.left, to.cosine), hn::Mul(swing.up, to.sine)));
    return {hn::Mul(swing.cosine, to.cosine), plus(bone, plus(axis, side))};
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#endif
