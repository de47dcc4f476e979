// Prepares solve_many: decides which chains can iterate, and corrects those that need it.
#include "ik/batch/vector.hpp"
#include "tendril/chain/segment.hpp"

#define HWY_TARGET_INCLUDE "ik/batch/classify.cpp"
#include "math/each_target-inl.hpp"

#include "ik/batch/step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

/// Metres: beyond this, floats are too coarse for the invariant of chain.hpp.
constexpr float precise_range = 1e3f;
// Fractions of the allowed length error: between them a float cannot decide; rounding is 1/300 of it.
constexpr float fit_threshold = 0.95f, loose_threshold = 1.05f;

/// False for NaN.
HWY_INLINE Mask are_valid(const Points& p) {
    const auto is_valid = [](Lanes x) { return hn::Le(hn::Abs(x), all(max_magnitude)); };
    return hn::And(is_valid(p.x), hn::And(is_valid(p.y), is_valid(p.z)));
}

HWY_INLINE Lanes largest(const Points& p, Lanes so_far) {
    return hn::Max(hn::Max(so_far, hn::Abs(p.x)), hn::Max(hn::Abs(p.y), hn::Abs(p.z)));
}

/// True if every bone of a register of chains is certainly at its length and, judging by root and reach, no
/// joint is too far out. One pass without a square root: |d^2 - l^2| <= 0.9 l a means that d is within 0.9 a
/// of l. False if a coordinate is not finite.
HWY_INLINE bool certainly_fits(const Block& block, std::size_t i) {
    Points from = load_points(block.joint(0) + i);
    const Lanes furthest = hn::Add(largest(from, zero()), load(block.reach() + i));
    Mask fits = hn::Le(furthest, all(0.99f * max_magnitude));
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        const Points to = load_points(block.joint(bone + 1) + i), apart = minus(to, from);
        const Lanes size = load(block.length(bone) + i);
        const Lanes off = hn::Abs(hn::Sub(dot(apart, apart), hn::Mul(size, size)));
        const Lanes allowed = hn::Mul(hn::Mul(hn::Max(all(1.0f), size), size), all(0.9f * 1e-4f));
        fits = hn::And(fits, hn::Le(off, allowed));
        from = to;
    }
    return hn::AllTrue(Floats(), fits);
}

/// Computes a bone's deviation from its length, and how much enforce_lengths (prepare.cpp) tolerates.
HWY_INLINE void compare(const Block& block, std::size_t bone, std::size_t i, Lanes& off, Lanes& allowed) {
    const float *const from = block.joint(bone) + i, *const to = block.joint(bone + 1) + i;
    const Lanes size = load(block.length(bone) + i);
    off = hn::Abs(hn::Sub(hn::Sqrt(squared_distance(from, to)), size));
    const Lanes ends = largest(load_points(to), largest(load_points(from), zero()));
    const Mask beyond = hn::Gt(ends, all(precise_range));
    allowed = hn::Add(hn::Mul(hn::Max(all(1.0f), size), all(1e-4f)),
                      hn::IfThenElseZero(beyond, hn::Mul(ends, all(FLT_EPSILON))));
}

struct Fit {
    Mask valid, loose, unclear;
};
/// Checks bone by bone, after certainly_fits() returned false.
HWY_INLINE Fit fit_of(const Block& block, std::size_t i) {
    Fit fit{are_valid(load_points(block.joint(0) + i)), none(), none()};
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        Lanes off, allowed;
        compare(block, bone, i, off, allowed);
        fit.valid = hn::And(fit.valid, are_valid(load_points(block.joint(bone + 1) + i)));
        fit.loose = hn::Or(fit.loose, hn::Gt(off, hn::Mul(allowed, all(loose_threshold))));
        const Mask unclear = hn::AndNot(fit.loose, hn::Ge(off, hn::Mul(allowed, all(fit_threshold))));
        const Lanes squared = squared_distance(block.joint(bone) + i, block.joint(bone + 1) + i);
        const Mask blind = hn::And(fit.loose, hn::Lt(squared, all(math::coincidence)));
        fit.unclear = hn::Or(fit.unclear, hn::Or(unclear, blind));
    }
    return fit;
}

/// Writes Row::Class for one register of chains. All thresholds allow for float rounding: closer cases are
/// left to the scalar code. Returns whether a bone of a reachable chain is loose.
HWY_INLINE bool classify_register(const Block& block, std::size_t i, Mask used) {
    const Lanes reach = load(block.reach() + i), longest = load(block.longest() + i);
    const Lanes rim = hn::Mul(reach, all(1e-5f));
    const Points target = load_points(block.target() + i);
    const Lanes distance = hn::Sqrt(squared_distance(block.joint(0) + i, block.target() + i));
    // Far enough that no joint coincides with the target.
    const Mask beyond = hn::Gt(distance, hn::Add(hn::Add(reach, rim), all(1e-3f)));
    const Mask within = hn::Lt(distance, hn::Sub(reach, rim));
    const Lanes nearest = hn::Sub(hn::Add(longest, longest), reach);
    const Mask unfolded = hn::Gt(distance, hn::Add(nearest, rim));
    // Closer to the root than a thousandth of `nearest`, the fold line depends on the chain: left to the
    // scalar code.
    const Mask folded =
        hn::And(hn::Lt(distance, hn::Sub(nearest, rim)), hn::Gt(distance, hn::Mul(nearest, all(1.1e-3f))));
    Mask valid = hn::And(used, are_valid(target));
    Mask reachable = hn::And(within, unfolded), loose = none();
    if (!certainly_fits(block, i)) {
        const Fit fit = fit_of(block, i);
        valid = hn::And(valid, fit.valid);
        reachable = hn::AndNot(fit.unclear, reachable);
        loose = fit.loose;
    }
    const auto code = [](Class value) { return all(static_cast<float>(value)); };
    Lanes found = hn::IfThenElse(reachable, code(Class::Reachable), code(Class::Scalar));
    found = hn::IfThenElse(folded, code(Class::Folded), found);
    found = hn::IfThenElse(beyond, code(Class::Straight), found);
    found = hn::IfThenElse(valid, found, code(Class::Invalid));
    store(found, block.row(Row::Class) + i);
    return any(hn::And(loose, equals(block.row(Row::Class) + i, Class::Reachable)));
}

/// Enforces lengths from the first loose bone on, if the target is reachable; like enforce_lengths in
/// prepare.cpp.
HWY_INLINE void enforce_lengths(const Block& block, std::size_t i) {
    float* const activity = block.row(Row::Activity);
    store(zero(), activity + i);
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        Lanes off, allowed;
        compare(block, bone, i, off, allowed);
        const Mask fails = hn::Gt(off, hn::Mul(allowed, all(loose_threshold)));
        const Mask loose = hn::And(fails, equals(block.row(Row::Class) + i, Class::Reachable));
        store(hn::IfThenElse(loose, all(static_cast<float>(Activity::Active)), load(activity + i)),
              activity + i);
        const float* const before = bone > 0 ? block.joint(bone - 1) : nullptr;
        step<true>({block.joint(bone), block.joint(bone + 1), block.length(bone), before}, activity, i);
    }
}

/// Places each joint towards the target from the rounded position of the previous one, so that rounding does
/// not add up to a bend. All registers take each joint side by side, so that none waits for its own square
/// root.
HWY_INLINE void straighten(const Block& block, std::size_t lanes) {
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(Floats())) {
            const Mask straight = equals(block.row(Row::Class) + i, Class::Straight);
            if (!any(straight)) continue;
            const Points at = load_points(block.joint(bone) + i);
            const Points ahead = minus(load_points(block.target() + i), at);
            const Lanes squared = hn::Max(dot(ahead, ahead), all(math::coincidence));
            const Lanes scale = hn::Div(load(block.length(bone) + i), hn::Sqrt(squared));
            float* const joint = block.joint(bone + 1) + i;
            store_points(select(straight, moved(at, ahead, scale), load_points(joint)), joint);
        }
    }
}

/// Points the longest bone at the target and all others back.
HWY_INLINE void fold(const Block& block, std::size_t i, Mask lanes) {
    Points at = load_points(block.joint(0) + i);
    Points along = minus(load_points(block.target() + i), at);
    along = times(along, hn::Div(all(1.0f), hn::Max(length(along), all(FLT_MIN))));
    const Lanes longest = load(block.longest() + i);
    Mask passed = none();
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        const Lanes size = load(block.length(bone) + i);
        const Mask ahead = hn::AndNot(passed, hn::Eq(size, longest));
        passed = hn::Or(passed, ahead);
        at = moved(at, along, hn::IfThenElse(ahead, size, hn::Neg(size)));
        float* const joint = block.joint(bone + 1) + i;
        store_points(select(lanes, at, load_points(joint)), joint);
    }
}

/// Lanes whose chains may have all joints on one line with the target. If they do, to 1e-5 of the reach
/// (perturbation.cpp), no arm's cross product with the target's arm exceeds twice that plus rounding. The
/// same holds if they are within `near_line` of the line to the target. One joint off the line is enough, so
/// checking the last two or three usually suffices.
HWY_INLINE Mask may_be_collinear(const Block& block, std::size_t i, Mask lanes, float near_line) {
    const Points root = load_points(block.joint(0) + i);
    const Points target = minus(load_points(block.target() + i), root);
    const Lanes reach = load(block.reach() + i);
    const Lanes near =
        hn::Mul(reach, hn::Add(hn::Mul(reach, all(4e-5f)), hn::Mul(length(target), all(near_line))));
    for (std::size_t joint = block.bones(); joint > 0 && any(lanes); --joint) {
        const Lanes off = length(cross(minus(load_points(block.joint(joint) + i), root), target));
        lanes = hn::And(lanes, hn::Le(off, near));
    }
    return lanes;
}

/// Initialises the state of a register's chains.
HWY_INLINE void begin_register(const Block& block, std::size_t i) {
    const Lanes residual = residual_of(block, i);
    for (const Row row : {Row::Residual, Row::Best, Row::Nearest, Row::Last}) {
        store(residual, block.row(row) + i);
    }
    for (const Row row : {Row::Saved, Row::Idle, Row::Slow, Row::Perturbations, Row::Iterations}) {
        store(zero(), block.row(row) + i);
    }
}

void classify(const Block& block, std::size_t lanes) {
    const Floats d;
    bool out_of_reach = false;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const Mask used = hn::FirstN(d, lanes - i);  // lanes beyond are invalid
        if (classify_register(block, i, used)) enforce_lengths(block, i);
        out_of_reach = out_of_reach || any(equals(block.row(Row::Class) + i, Class::Straight));
    }
    if (out_of_reach) straighten(block, lanes);
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const float* const found = block.row(Row::Class) + i;
        if (const Mask folded = equals(found, Class::Folded); any(folded)) fold(block, i, folded);
    }
}

/// Lanes whose tip may be at the root, by the rule of pole.cpp.
HWY_INLINE Mask may_be_closed(const Block& block, std::size_t i) {
    const Lanes near =
        hn::Mul(load(block.reach() + i), all(1.1f * static_cast<float>(tune::pole::closed_tip)));
    return hn::Le(squared_distance(block.joint(0) + i, block.joint(block.bones()) + i), hn::Mul(near, near));
}

Remaining begin(const Block& block, std::size_t lanes, bool every, bool planar) {
    const float near_line = planar ? 1.1f * static_cast<float>(tune::pole::straight) : 0.0f;
    const Floats d;
    Remaining left;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        float* const found = block.row(Row::Class) + i;
        begin_register(block, i);
        const Mask converged =
            hn::Le(load(block.row(Row::Residual) + i), load(block.row(Row::Tolerance) + i));
        const Mask reachable = equals(found, Class::Reachable);
        const Mask unsolved = hn::AndNot(converged, reachable);
        Mask collinear = may_be_collinear(block, i, unsolved, near_line);
        if (planar) collinear = hn::Or(collinear, hn::And(unsolved, may_be_closed(block, i)));
        if (any(collinear)) {
            store(hn::IfThenElse(collinear, all(static_cast<float>(Class::Collinear)), load(found)), found);
            left.perturb = true;
        }
        const Mask active = every ? reachable : hn::AndNot(converged, reachable);
        store(hn::IfThenElseZero(active, all(static_cast<float>(Activity::Active))),
              block.row(Row::Activity) + i);
        left.active += hn::CountTrue(d, active);
    }
    return left;
}

void classify_limited(const Block& block, std::size_t lanes) {
    const Floats d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        float* const found = block.row(Row::Class) + i;
        if (classify_register(block, i, hn::FirstN(d, lanes - i))) enforce_lengths(block, i);
        const Mask keeps = hn::Or(equals(found, Class::Reachable), equals(found, Class::Invalid));
        store(hn::IfThenElse(keeps, load(found), all(static_cast<float>(Class::Scalar))), found);
        begin_register(block, i);
        store(zero(), block.row(Row::Activity) + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::ik::detail {
namespace {
HWY_EXPORT(classify);
HWY_EXPORT(begin);
HWY_EXPORT(classify_limited);
}  // namespace

Classify* classify_with(std::int64_t target) noexcept {
    return TENDRIL_COMPILED_FOR(classify, target);
}
Begin* begin_with(std::int64_t target) noexcept {
    return TENDRIL_COMPILED_FOR(begin, target);
}
ClassifyLimited* classify_limited_with(std::int64_t target) noexcept {
    return TENDRIL_COMPILED_FOR(classify_limited, target);
}

}  // namespace tendril::ik::detail
#endif
