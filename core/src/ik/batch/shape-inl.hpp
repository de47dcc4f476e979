// The step that makes FABRIK fast near full reach (methods/accelerate.cpp) for a register of chains: the same
// operations in the same order, so the same bits. Branches of the scalar code become masks; rare cases run
// only if a register has one. Not installed; included once per vector unit.
#if defined(TENDRIL_IK_BATCH_SHAPE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TENDRIL_IK_BATCH_SHAPE_INL
#undef TENDRIL_IK_BATCH_SHAPE_INL
#else
#define TENDRIL_IK_BATCH_SHAPE_INL
#endif

#include <cfloat>

#include "ik/batch/step-inl.hpp"
#include "ik/tunables.hpp"
#include "math/rotation.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

/// A family of shapes per chain, parametrised by t; see accelerate.cpp.
struct Family {
    Points line, first, aim;
    Lanes wanted, straight, now;
    Mask turns_longest;
};

/// The bones of a shape, bone after bone, one register per coordinate.
class Shape {
  public:
    explicit Shape(float* bones) : bones_(bones) {}
    void set(std::size_t bone, const Points& p) const {
        float* const to = bones_ + bone * 3 * size();
        store(p.x, to), store(p.y, to + size()), store(p.z, to + 2 * size());
    }
    Points of(std::size_t bone) const {
        const float* const from = bones_ + bone * 3 * size();
        return {load(from), load(from + size()), load(from + 2 * size())};
    }
    static std::size_t floats(std::size_t bones) { return 3 * bones * size(); }

  private:
    static std::size_t size() { return hn::Lanes(Floats()); }
    float* bones_;
};

/// Finds the first of the longest bones of each chain; call `is` once per bone, in order.
class LongestBone {
  public:
    LongestBone(const Block& block, std::size_t i) : longest_(load(block.longest() + i)), passed_(none()) {}
    Mask is(Lanes size) {
        const Mask here = hn::AndNot(passed_, hn::Eq(size, longest_));
        passed_ = hn::Or(passed_, here);
        return here;
    }

  private:
    Lanes longest_;
    Mask passed_;
};

/// Writes the bones of a shape and returns their span. `keeps_longest`: leaves the longest bone as it is.
template <bool keeps_longest>
HWY_INLINE Points write_shape(const Block& block, std::size_t i, const Family& family, Lanes t,
                              const Shape& out) {
    const Points towards = times(family.line, hn::Sub(all(1.0f), t));
    LongestBone longest(block, i);
    Points span = family.first, from = load_points(block.joint(0) + i);
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        const Points to = load_points(block.joint(bone + 1) + i), apart = minus(to, from);
        const Lanes size = load(block.length(bone) + i);
        const Points blend = moved(times(apart, t), towards, size);
        const Lanes squared = dot(blend, blend);
        Points shaped = times(blend, hn::Div(size, hn::Sqrt(squared)));
        const Mask shows = hn::Gt(squared, all(FLT_MIN));
        if (HWY_UNLIKELY(!hn::AllTrue(Floats(), shows))) {
            shaped = select(shows, shaped, times(family.line, size));
        }
        if constexpr (keeps_longest) {
            const Mask stays = longest.is(size);
            span = select(stays, span, plus(span, shaped));
            shaped = select(stays, apart, shaped);
        } else {
            span = plus(span, shaped);
        }
        out.set(bone, shaped);
        from = to;
    }
    return span;
}

struct BestShape {
    Points span;
    Lanes size, error;
    Mask found;   ///< the wanted length was bracketed
    Mask second;  ///< the second try is better
};

/// Finds the t^2 at which the span has the wanted length, in two tries: regula falsi.
template <bool keeps_longest>
HWY_INLINE BestShape fit_shape(const Block& block, std::size_t i, const Family& family, Lanes near,
                               Mask lanes, const Shape& one, const Shape& two) {
    const auto bounded = [](Lanes next) {
        const Mask fine = hn::And(hn::Ge(next, zero()), hn::Le(next, all(tune::chain::max_bend)));
        return hn::IfThenElse(fine, next, all(tune::chain::max_bend));  // also for NaN: 0 / 0
    };
    Lanes low = zero(), at_low = hn::Sub(family.straight, family.wanted);
    Lanes high = all(1.0f), at_high = hn::Sub(family.now, family.wanted);
    BestShape best;
    best.found = hn::Xor(hn::Lt(at_low, zero()), hn::Lt(at_high, zero()));
    best.second = none();
    Lanes next = bounded(hn::Div(at_low, hn::Sub(at_low, at_high)));
    best.span = write_shape<keeps_longest>(block, i, family, hn::Sqrt(next), one);
    best.size = length(best.span);
    Lanes off = hn::Sub(best.size, family.wanted);
    best.error = hn::Abs(off);
    const Mask again = hn::AndNot(hn::Le(best.error, near), lanes);
    if (!any(again)) return best;

    const Mask crosses = hn::Xor(hn::Lt(off, zero()), hn::Lt(at_low, zero()));
    const Mask takes_high = hn::AndNot(best.found, crosses), bracketed = hn::Or(best.found, crosses);
    low = hn::IfThenElse(takes_high, high, low), at_low = hn::IfThenElse(takes_high, at_high, at_low);
    const Mask raises_low = hn::AndNot(crosses, best.found);
    low = hn::IfThenElse(raises_low, next, low), at_low = hn::IfThenElse(raises_low, off, at_low);
    high = hn::IfThenElse(crosses, next, high), at_high = hn::IfThenElse(crosses, off, at_high);
    const Lanes between =
        hn::Add(low, hn::Mul(hn::Sub(high, low), hn::Div(at_low, hn::Sub(at_low, at_high))));
    // Still too short with the estimated bend.
    const Lanes strong = hn::Max(next, all(tune::chain::strong_bend));
    next = bounded(hn::IfThenElse(bracketed, between, strong));
    best.found = hn::Or(best.found, hn::And(again, crosses));
    const Points span = write_shape<keeps_longest>(block, i, family, hn::Sqrt(next), two);
    const Lanes size = length(span);
    off = hn::Sub(size, family.wanted);
    const Lanes error = hn::Abs(off);
    best.second = hn::And(again, hn::Lt(error, best.error));
    best.span = select(best.second, span, best.span);
    best.size = hn::IfThenElse(best.second, size, best.size);
    best.error = hn::IfThenElse(best.second, error, best.error);
    const Mask continues = hn::AndNot(hn::Le(best.error, near), again);
    const Mask crosses_now = hn::Xor(hn::Lt(off, zero()), hn::Lt(at_low, zero()));
    best.found = hn::Or(best.found, hn::And(continues, crosses_now));
    return best;
}

/// All bones, or all except the longest, bend or straighten; `span` is their span.
HWY_INLINE Family blend_of(const Points& span, const Points& aim, Lanes reach) {
    Family family;
    family.aim = aim;
    family.first = {zero(), zero(), zero()};
    family.wanted = length(aim);
    family.straight = reach;
    family.now = length(span);
    // If the ends meet, they define no line.
    const Mask open = hn::Gt(family.now, hn::Mul(all(1e-6f), reach));
    const Lanes size = hn::IfThenElse(open, family.now, family.wanted);
    const Mask shows = hn::Gt(size, all(FLT_MIN));
    const Lanes scale = hn::IfThenElseZero(shows, hn::Div(all(1.0f), size));
    family.line = select(shows, times(select(open, span, aim), scale), family.first);
    family.turns_longest = hn::Not(none());
    return family;
}

/// Keeps the longest bone and lets the others compensate: by bending, or if they are too short for the
/// remaining distance, by folding back along it.
HWY_INLINE Family family_around_longest(const Block& block, std::size_t i, const Points& span,
                                        const Family& whole) {
    LongestBone longest(block, i);
    Points bone = whole.first, from = load_points(block.joint(0) + i);
    for (std::size_t index = 0; index < block.bones(); ++index) {
        const Points to = load_points(block.joint(index + 1) + i);
        bone = select(longest.is(load(block.length(index) + i)), minus(to, from), bone);
        from = to;
    }
    const Lanes size = load(block.longest() + i), others = hn::Sub(load(block.reach() + i), size);
    const Points left = minus(whole.aim, bone);
    const Mask bends = hn::Le(length(left), others);
    const Family bent = blend_of(minus(span, bone), left, others);
    const auto choose = [&](Lanes yes, Lanes no) { return hn::IfThenElse(bends, yes, no); };
    Family family;
    family.line = select(bends, bent.line, times(bone, hn::Div(all(-1.0f), size)));
    family.first = select(bends, bent.first, bone);
    family.aim = select(bends, bent.aim, whole.aim);
    family.wanted = choose(bent.wanted, whole.wanted);
    family.straight = choose(bent.straight, hn::Abs(hn::Sub(size, others)));
    family.now = choose(bent.now, whole.now);
    family.turns_longest = hn::Not(bends);
    return family;
}

/// The minimal rotation from one direction to another, as two reflections. Identity if one of them has no
/// direction.
class Turn {
  public:
    Turn(const Points& from, Lanes from_size, const Points& to, Lanes to_size) {
        const Mask shows = hn::And(hn::Gt(from_size, all(FLT_MIN)), hn::Gt(to_size, all(FLT_MIN)));
        const Points start = times(from, hn::Div(all(1.0f), from_size)),
                     end = times(to, hn::Div(all(1.0f), to_size));
        first_ = plus(start, end);
        const Mask opposite = hn::And(shows, hn::Lt(dot(first_, first_), all(1e-10f)));
        if (HWY_UNLIKELY(any(opposite))) first_ = select(opposite, perpendicular(end), first_);
        const Points nothing{zero(), zero(), zero()};
        twice_first_ = select(shows, times(first_, hn::Div(all(2.0f), dot(first_, first_))), nothing);
        first_ = select(shows, first_, nothing);
        second_ = select(shows, end, nothing);
        twice_second_ = times(second_, all(2.0f));
    }
    Points of(Points v) const {
        v = moved(v, first_, hn::Neg(dot(twice_first_, v)));
        return moved(v, second_, hn::Neg(dot(twice_second_, v)));
    }

  private:
    /// Computed lane by lane, since it is rare.
    static Points perpendicular(const Points& to) {
        HWY_ALIGN float x[16], y[16], z[16];
        store(to.x, x), store(to.y, y), store(to.z, z);
        for (std::size_t lane = 0; lane < hn::Lanes(Floats()); ++lane) {
            const glm::vec3 side = math::perpendicular(glm::vec3(x[lane], y[lane], z[lane]));
            x[lane] = side.x, y[lane] = side.y, z[lane] = side.z;
        }
        return {load(x), load(y), load(z)};
    }

    Points first_, second_, twice_first_, twice_second_;
};

/// Places the chains in `lanes` with the bones of their best shape, turned onto the aim.
template <bool keeps_longest>
HWY_INLINE void place_shape(const Block& block, std::size_t i, Mask lanes, const Family& family,
                            const BestShape& best, const Shape& one, const Shape& two) {
    const Turn turn(best.span, best.size, family.aim, family.wanted);
    LongestBone longest(block, i);
    Points at = load_points(block.joint(0) + i);
    for (std::size_t bone = 0; bone < block.bones(); ++bone) {
        const Points shaped = select(best.second, two.of(bone), one.of(bone));
        Points turned = turn.of(shaped);
        if constexpr (keeps_longest) {
            const Mask stays = longest.is(load(block.length(bone) + i));
            turned = select(hn::AndNot(family.turns_longest, stays), shaped, turned);
        }
        float* const joint = block.joint(bone + 1) + i;
        const Points to = plus(at, turned);
        store_points(select(lanes, to, load_points(joint)), joint);
        at = to;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#endif
