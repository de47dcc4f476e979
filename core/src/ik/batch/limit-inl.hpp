// Quaternions of a whole register of chains, and the clamp of a joint to its limit. Not installed; it is
// included once for each vector unit.
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
/// First `b`, then `a`.
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

/// Angle of a point (cosine, sine) of the unit circle, both not negative: 0 to pi/2, to 1e-7.
/// Polynomial 4.4.49 of Abramowitz and Stegun, Handbook of Mathematical Functions, for half of it.
HWY_INLINE Lanes angle_of(Lanes cosine, Lanes sine) {
    const Lanes t = hn::Div(sine, hn::Add(all(1.0f), cosine)), t2 = hn::Mul(t, t);
    Lanes sum = all(0.0028662257f);
    for (const float factor : {-0.0161657367f, 0.0429096138f, -0.0752896400f, 0.1065626393f, -0.1420889944f,
                               0.1999355085f, -0.3333314528f, 1.0f}) {
        sum = hn::Add(hn::Mul(sum, t2), all(factor));
    }
    return hn::Mul(hn::Mul(sum, t), all(2.0f));
}
/// Of an angle from 0 to pi/2, to 1e-7: the Taylor series.
HWY_INLINE Lanes sine_of(Lanes angle) {
    const Lanes x2 = hn::Mul(angle, angle);
    Lanes sum = all(-1.0f / 39916800.0f);
    for (const float factor : {1.0f / 362880.0f, -1.0f / 5040.0f, 1.0f / 120.0f, -1.0f / 6.0f, 1.0f}) {
        sum = hn::Add(hn::Mul(sum, x2), all(factor));
    }
    return hn::Mul(sum, angle);
}
HWY_INLINE Lanes other_leg(Lanes sine) {
    return hn::Sqrt(hn::Max(hn::Sub(all(1.0f), hn::Mul(sine, sine)), zero()));
}

/// Where a joint stands against its limit.
struct Standing {
    Points outward;      ///< the axis of a swing that lies on the rim; zero inside
    Lanes upper, lower;  ///< 1 where the hinge or the twist is at that end of its range
    Standing() : outward{zero(), zero(), zero()}, upper(zero()), lower(zero()) {}
};

/// The rotation about a unit axis with this cosine and sine of half its angle, brought into the range.
HWY_INLINE void clamp_half(const HalfRange& range, Lanes& cosine, Lanes& sine, Standing* standing) {
    const Lanes size = hn::Sqrt(hn::Add(hn::Mul(cosine, cosine), hn::Mul(sine, sine)));
    const Mask shows = hn::Gt(size, all(1e-6f));
    const Lanes scale = hn::CopySign(hn::Div(all(1.0f), size), cosine);  // the shorter way round
    sine = hn::IfThenElseZero(shows, hn::Mul(sine, scale));
    cosine = hn::IfThenElse(shows, hn::Abs(hn::Mul(cosine, scale)), all(1.0f));
    if (range.whole) return;
    const Lanes clamped = hn::Min(hn::Max(sine, all(range.min)), all(range.max));
    cosine = hn::IfThenElse(hn::Eq(clamped, sine), cosine, other_leg(clamped));
    sine = clamped;
    if (standing == nullptr) return;
    constexpr float near = 5e-5f;  // half of at_bound
    standing->upper = hn::IfThenElseZero(hn::Ge(sine, all(range.max - near)), all(1.0f));
    standing->lower = hn::IfThenElseZero(hn::Le(sine, all(range.min + near)), all(1.0f));
}

/// A swing, given by its half angle's cosine and by its vector across the bone, brought into its cone: along
/// its own direction, to the rim.
HWY_INLINE void clamp_swing(const BatchLimit& limit, Lanes& cosine, Lanes& up, Lanes& left,
                            Standing* standing) {
    const Mask upward = hn::Ge(up, zero()), leftward = hn::Ge(left, zero());
    const Lanes a = hn::IfThenElse(upward, all(limit.up), all(limit.down)),
                b = hn::IfThenElse(leftward, all(limit.left), all(limit.right));
    // In units of the rim at that direction, squared, but for what the sine is less than the angle.
    const Lanes outside = hn::Add(hn::Mul(hn::Mul(up, up), a), hn::Mul(hn::Mul(left, left), b));
    constexpr float pi = 3.14159265f;
    const Mask surely_inside = hn::Lt(hn::Mul(outside, all(pi * pi)), all(1.0f));
    if (hn::AllTrue(Floats(), surely_inside)) return;
    const Lanes sine = hn::Sqrt(hn::Max(hn::Add(hn::Mul(up, up), hn::Mul(left, left)), all(1e-20f)));
    const Lanes angle = hn::Mul(all(2.0f), angle_of(hn::Min(cosine, all(1.0f)), sine));
    // The rim's angle is sine / sqrt(outside).
    const Lanes rim = hn::Div(sine, hn::Sqrt(hn::Max(outside, all(1e-20f))));
    const Mask beyond = hn::Gt(angle, rim);
    const Lanes new_sine = sine_of(hn::Mul(all(0.5f), rim));
    const Lanes scale = hn::IfThenElse(beyond, hn::Div(new_sine, sine), all(1.0f));
    if (standing != nullptr) {
        const Mask on_rim = hn::AndNot(surely_inside, hn::Gt(angle, hn::Mul(rim, all(1.0f - 1e-4f))));
        // Outward is where the ellipse's normal points.
        const Lanes nu = hn::Mul(up, a), nl = hn::Mul(left, b);
        const Points normal = plus(times(all(limit.axis), nu), times(all(limit.side), nl));
        const Lanes unit = hn::Div(all(1.0f), hn::Sqrt(hn::Max(dot(normal, normal), all(1e-20f))));
        standing->outward = times(normal, hn::IfThenElseZero(on_rim, unit));
    }
    up = hn::Mul(up, scale), left = hn::Mul(left, scale);
    cosine = hn::IfThenElse(beyond, other_leg(new_sine), cosine);
}

/// The rotation of a bone against its parent, a unit quaternion, brought within its limit.
HWY_INLINE Rotations clamp(const BatchLimit& limit, const Rotations& turn, Standing* standing) {
    if (limit.kind == BatchLimit::Kind::Free) return turn;
    if (limit.kind == BatchLimit::Kind::Hinge) {
        Lanes cosine = turn.w, sine = dot(turn.v, all(limit.axis));
        clamp_half(limit.range, cosine, sine, standing);
        return {cosine, times(all(limit.axis), sine)};
    }
    const Points bone = all(limit.bone);
    Lanes twist_cosine = turn.w, twist_sine = dot(turn.v, bone);
    clamp_half(HalfRange(), twist_cosine, twist_sine, nullptr);
    const Rotations swing = compose(turn, conjugate({twist_cosine, times(bone, twist_sine)}));
    const Lanes sign = hn::CopySign(all(1.0f), swing.w);
    Lanes cosine = hn::Abs(swing.w), up = hn::Mul(sign, dot(swing.v, all(limit.axis))),
          left = hn::Mul(sign, dot(swing.v, all(limit.side)));
    clamp_swing(limit, cosine, up, left, standing);
    clamp_half(limit.range, twist_cosine, twist_sine, standing);
    const Rotations clamped{cosine, plus(times(all(limit.axis), up), times(all(limit.side), left))};
    return compose(clamped, {twist_cosine, times(bone, twist_sine)});
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#endif
