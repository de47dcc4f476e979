// The step that makes FABRIK fast near full reach, and elsewhere if it converges slowly.
//
// A pass hands a bend on from joint to joint and removes little of it, so a chain whose tip falls short by
// one in a thousand needs hundreds of passes to straighten that much. This step keeps the shape that the
// passes found and scales its bend as a whole. With u a bone's direction and l the direction from root to
// tip, every bone gets the direction of
//
// l + t (u - l)
//
// with one t for all: at 0 the chain is straight, at 1 unchanged, and over 1 it bends more. The span from
// root to tip is nearly linear in t^2, so two tries come close to the t at which the span equals the target's
// distance (regula falsi: if the chain falls short, there always is one between 0 and 1). Then the whole
// chain is turned towards the target.
//
// If bending cannot bring the ends close enough together, the longest bone is kept and the others do the same
// for the remaining distance to the target; or, if they are too short for that, they fold back along the
// longest.
//
// Cost: O(n), usually one or two square roots per bone. Unlike a pass's, they are independent, so the step
// takes about as long as the passes.
#include "ik/methods/methods.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "ik/math.hpp"
#include "ik/tunables.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::chain;

/// A family of shapes, parametrised by t. May exclude the longest bone.
struct Family {
    glm::vec3 line{0.0f};       ///< unit vector towards which the bones turn
    std::size_t fixed = 0;      ///< index of the bone that does not turn; the number of bones if none
    glm::vec3 first{0.0f};      ///< start of the span: the fixed bone, or zero
    glm::vec3 aim{0.0f};        ///< required end of the span, after turning it
    bool rotates_fixed = true;  ///< the turn includes the fixed bone
    float wanted = 0.0f;        ///< length of `aim`
    float straight = 0.0f;      ///< length of the span at t = 0
    float now = 0.0f;           ///< length of the span at t = 1
};

struct FamilyFit {
    float t = 1.0f;
    glm::vec3 span{0.0f};
    float size = 0.0f;       ///< length of `span`
    float error = FLT_MAX;   ///< deviation from the wanted length
    bool found = false;      ///< the wanted length was bracketed
    bool is_shaped = false;  ///< scratch.old holds this shape
};

/// Writes the bones of a shape into scratch.old and returns their span.
glm::vec3 shape(Problem& problem, const Family& family, float t) noexcept {
    const glm::vec3* joints = problem.joints.data();
    const float* lengths = problem.lengths().data();
    glm::vec3* bones = problem.scratch.old.data();
    const glm::vec3 towards = times(family.line, 1.0f - t);
    const auto part = [&](std::size_t from, std::size_t to, glm::vec3 span) {
        for (std::size_t i = from; i < to; ++i) {
            const glm::vec3 blend = moved(times(minus(joints[i + 1], joints[i]), t), towards, lengths[i]);
            const float squared = dot(blend, blend);
            // A bone exactly opposite to the line vanishes halfway.
            bones[i] = squared > FLT_MIN ? times(blend, lengths[i] / std::sqrt(squared))
                                         : times(family.line, lengths[i]);
            span = plus(span, bones[i]);
        }
        return span;
    };
    const std::size_t count = problem.bones();
    const glm::vec3 span = part(0, std::min(family.fixed, count), family.first);
    if (family.fixed >= count) return span;
    bones[family.fixed] = minus(joints[family.fixed + 1], joints[family.fixed]);
    return part(family.fixed + 1, count, span);
}

/// Finds the t^2 at which the span has the wanted length, in a few tries of regula falsi; returns the best.
FamilyFit fit_family(Problem& problem, const Family& family, float near) noexcept {
    float low = 0.0f, at_low = family.straight - family.wanted;
    float high = 1.0f, at_high = family.now - family.wanted;
    FamilyFit best;
    best.found = (at_low < 0.0f) != (at_high < 0.0f);
    float next = at_low / (at_low - at_high);
    for (int i = 0; i < tries; ++i) {
        if (!(next >= 0.0f && next <= max_bend)) next = max_bend;  // also for NaN: 0 / 0
        const float t = std::sqrt(next);
        const glm::vec3 span = shape(problem, family, t);
        const float size = length(span), off = size - family.wanted;
        best.is_shaped = std::abs(off) < best.error;
        if (best.is_shaped) best.t = t, best.span = span, best.size = size, best.error = std::abs(off);
        if (best.error <= near) break;
        if ((off < 0.0f) != (at_low < 0.0f)) {
            if (!best.found) low = high, at_low = at_high;
            best.found = true;
            high = next, at_high = off;
        } else if (best.found) {
            low = next, at_low = off;
        } else {  // still too short with the estimated bend
            next = std::max(next, strong_bend);
            continue;
        }
        next = low + (high - low) * (at_low / (at_low - at_high));
    }
    return best;
}

/// All bones except the fixed one bend or straighten; `span` is their span.
Family blend_of(const glm::vec3& span, const glm::vec3& aim, float reach, std::size_t fixed) noexcept {
    Family family;
    family.fixed = fixed;
    family.aim = aim;
    family.wanted = length(aim);
    family.straight = reach;
    family.now = length(span);
    // If the ends meet, they define no line.
    const bool open = family.now > 1e-6f * reach;
    const float size = open ? family.now : family.wanted;
    if (size > FLT_MIN) family.line = times(open ? span : aim, 1.0f / size);
    return family;
}

/// Keeps the longest bone and lets the others compensate: by bending, or if they are too short for the
/// remaining distance, by folding back along it.
Family family_around_longest(const Problem& problem, const glm::vec3& span, const Family& all) noexcept {
    const auto lengths = problem.lengths();
    const auto longest =
        static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
    const float size = lengths[longest], others = problem.scratch.reach - size;
    const glm::vec3 bone = minus(problem.joints[longest + 1], problem.joints[longest]);
    const glm::vec3 left = minus(all.aim, bone);
    if (length(left) <= others) {
        Family family = blend_of(minus(span, bone), left, others, longest);
        family.rotates_fixed = false;
        return family;
    }
    Family family = all;
    family.fixed = longest;
    family.first = bone;
    family.line = times(bone, -1.0f / size);
    family.straight = std::abs(size - others);
    return family;
}

/// The minimal rotation from one direction to another, as two reflections: one that takes the first direction
/// to the opposite of the second, then one that reverses it. Identity if one of them has no direction.
class ShortestRotation {
  public:
    ShortestRotation(const glm::vec3& from, float from_size, const glm::vec3& to, float to_size) noexcept {
        if (!(from_size > FLT_MIN && to_size > FLT_MIN)) return;
        const glm::vec3 start = times(from, 1.0f / from_size), end = times(to, 1.0f / to_size);
        first_ = plus(start, end);
        if (dot(first_, first_) < 1e-10f) first_ = perpendicular(end);  // half a turn
        twice_first_ = times(first_, 2.0f / dot(first_, first_));
        second_ = end;
        twice_second_ = times(end, 2.0f);
    }
    glm::vec3 of(glm::vec3 v) const noexcept {
        v = moved(v, first_, -dot(twice_first_, v));
        return moved(v, second_, -dot(twice_second_, v));
    }

  private:
    glm::vec3 first_{0.0f}, second_{0.0f}, twice_first_{0.0f}, twice_second_{0.0f};
};

/// Places the chain with the bones in scratch.old, turned so that `span` ends at the family's aim.
template <class Watch>
void place_shape(Problem& problem, const Family& family, const ShortestRotation& rotation,
                 Watch watch) noexcept {
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::vec3& bone = problem.scratch.old[i];
        const bool rotates = i != family.fixed || family.rotates_fixed;
        const glm::vec3 to = plus(problem.joints[i], rotates ? rotation.of(bone) : bone);
        watch.moved(problem.iteration, Phase::Accelerate, i + 1, i, problem.joints[i + 1], to);
        problem.joints[i + 1] = to;
    }
    watch.next_step();
}

}  // namespace

template <class Watch>
void accelerate(Problem& problem, float residual, Watch watch) noexcept {
    const float reach = problem.scratch.reach;
    const float near = std::max(0.25f * problem.tolerance, 1e-6f * reach);
    const glm::vec3 span = minus(problem.joints.back(), problem.root());
    Family family = blend_of(span, minus(problem.target, problem.root()), reach, problem.bones());
    FamilyFit best = fit_family(problem, family, near);
    if (!best.found || best.error > 0.5f * residual) {
        const Family other = family_around_longest(problem, span, family);
        const FamilyFit with_other = fit_family(problem, other, near);
        best.is_shaped = false;
        if (with_other.error < best.error) family = other, best = with_other;
    }
    if (!(best.error < residual)) return;
    if (!best.is_shaped) shape(problem, family, best.t);
    place_shape(problem, family, ShortestRotation(best.span, best.size, family.aim, family.wanted), watch);
}

template void accelerate(Problem&, float, Unwatched) noexcept;
template void accelerate(Problem&, float, Watched) noexcept;

}  // namespace tendril::ik::detail
