#include "ik/spread.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "ik/rotation.hpp"

namespace tendril::ik::detail {
namespace {

constexpr int tries = 4;             ///< spans worked out for one family of shapes
constexpr float strong_bend = 1e6f;  ///< of t^2: where the bones of a chain that was bent point sideways
constexpr float most_bend = 1e10f;   ///< of t^2: there the last trace of a bend has become one

/// Shapes that differ by t. The longest bone may be left out of it.
struct Family {
    std::span<const glm::vec3> directions;
    std::span<const float> lengths;
    glm::vec3 line{0.0f};    ///< towards which the bones turn, a unit vector
    std::size_t held;        ///< the bone that does not turn; the number of bones for none
    glm::vec3 before{0.0f};  ///< what the span starts with: the held bone, or nothing
    float wanted = 0.0f;     ///< the size that the span should have
    float size_straight = 0.0f, size_now = 0.0f;  ///< of the span at t = 0 and 1
};

glm::vec3 blended(const glm::vec3& direction, const glm::vec3& line, float t) noexcept {
    return moved(line, minus(direction, line), t);
}

/// What makes a blend as long as its bone; 0 for one that is just opposite to the line and vanishes.
float scale_of(const glm::vec3& blend, float length) noexcept {
    const float squared = dot(blend, blend);
    return squared > FLT_MIN ? length / std::sqrt(squared) : 0.0f;
}

glm::vec3 span_of_part(const Family& family, std::size_t from, std::size_t to, float t,
                       glm::vec3 span) noexcept {
    for (std::size_t i = from; i < to; ++i) {
        const glm::vec3 blend = blended(family.directions[i], family.line, t);
        span = moved(span, blend, scale_of(blend, family.lengths[i]));
    }
    return span;
}

glm::vec3 span_of(const Family& family, float t) noexcept {
    const std::size_t bones = family.lengths.size(), held = std::min(family.held, bones);
    const glm::vec3 span = span_of_part(family, 0, held, t, family.before);
    return span_of_part(family, std::min(held + 1, bones), bones, t, span);
}

struct Fit {
    float t = 1.0f;
    glm::vec3 span{0.0f};
    float error = FLT_MAX;  ///< by how much the span's size misses
    bool found = false;     ///< whether one side of it was seen to be too much and the other too little
};

/// The best of a few tries at the t^2 where the span is as wanted: regula falsi in its Illinois form.
Fit fit(const Family& family, float near) noexcept {
    float low = 0.0f, at_low = family.size_straight - family.wanted;
    float high = 1.0f, at_high = family.size_now - family.wanted;
    Fit best;
    best.found = (at_low < 0.0f) != (at_high < 0.0f);
    float next = at_low / (at_low - at_high);
    bool was_low = false, was_high = false;  // which end the last try replaced
    for (int i = 0; i < tries; ++i) {
        if (!(next >= 0.0f && next <= most_bend)) next = most_bend;  // and not a number: 0 / 0
        const float t = std::sqrt(next);
        const glm::vec3 span = span_of(family, t);
        const float off = length(span) - family.wanted;
        if (std::abs(off) < best.error) best.t = t, best.span = span, best.error = std::abs(off);
        if (best.error <= near) break;
        if ((off < 0.0f) == (at_low < 0.0f)) {
            if (!best.found) {  // bent as far as seemed enough, and it was not
                if (i > 0) break;
                next = std::max(next, strong_bend);
                continue;
            }
            low = next, at_low = off;
            if (was_low) at_high *= 0.5f;
        } else {
            if (!best.found) low = high, at_low = at_high;
            best.found = true;
            high = next, at_high = off;
            if (was_high) at_low *= 0.5f;
        }
        was_high = high == next, was_low = !was_high;
        next = low + (high - low) * (at_low / (at_low - at_high));
    }
    return best;
}

struct Rotation {
    glm::vec3 x{1.0f, 0.0f, 0.0f}, y{0.0f, 1.0f, 0.0f}, z{0.0f, 0.0f, 1.0f};  ///< where the axes go

    glm::vec3 of(const glm::vec3& v) const noexcept { return moved(moved(times(x, v.x), y, v.y), z, v.z); }
};

/// The least one from the direction of `from` to that of `to`; none where one of them has no direction.
Rotation least_turn(const glm::vec3& from, const glm::vec3& to) noexcept {
    const float a = length(from), b = length(to);
    Rotation turn;
    if (!(a > FLT_MIN && b > FLT_MIN)) return turn;
    const glm::quat q = least_rotation(times(from, 1.0f / a), times(to, 1.0f / b));
    return {rotated(q, turn.x), rotated(q, turn.y), rotated(q, turn.z)};
}

/// Lays the chain in the shape that was found. `turn` is for every bone, or for all but the held one.
template <class Watch>
void lay(Problem& problem, const Family& family, float t, const Rotation& turn, bool turns_held,
         Watch watch) noexcept {
    const Rotation none;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const bool held = i == family.held;
        const glm::vec3 blend = held ? family.directions[i] : blended(family.directions[i], family.line, t);
        const glm::vec3 along = (held && !turns_held ? none : turn).of(blend);
        const glm::vec3 to = moved(problem.joints[i], along, scale_of(blend, family.lengths[i]));
        watch.moved(problem.iteration, Phase::Spread, i + 1, i, problem.joints[i + 1], to);
        problem.joints[i + 1] = to;
    }
    watch.next_step();
}

void find_directions(Problem& problem) noexcept {
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::vec3 bone = minus(problem.joints[i + 1], problem.joints[i]);
        problem.room.old[i] = times(bone, scale_of(bone, 1.0f));
    }
}

struct Answer {
    Family family;
    Fit fit;
    glm::vec3 aim{0.0f};  ///< where the span is turned to
    bool turns_held = true;
};

/// All bones bend or straighten.
Answer with_all(const Family& all, const glm::vec3& span, const glm::vec3& wanted, float reach,
                float near) noexcept {
    Answer answer{all, {}, wanted};
    answer.family.size_now = length(span);
    answer.family.size_straight = reach;
    answer.family.wanted = length(wanted);
    // A tip on the root shows no line.
    const bool closed = answer.family.size_now <= 1e-6f * reach;
    const glm::vec3& along = closed ? wanted : span;
    answer.family.line = times(along, scale_of(along, 1.0f));
    if (std::abs(answer.family.size_now - answer.family.wanted) <= near) {  // the turn is enough
        answer.fit = {1.0f, span, std::abs(answer.family.size_now - answer.family.wanted), true};
    } else {
        answer.fit = fit(answer.family, near);
    }
    return answer;
}

/// The longest bone stays as it is, and the others make up for it.
Answer with_longest_held(const Family& all, const glm::vec3& span, const glm::vec3& wanted, float reach,
                         float near) noexcept {
    const std::size_t longest = static_cast<std::size_t>(
        std::max_element(all.lengths.begin(), all.lengths.end()) - all.lengths.begin());
    const float size = all.lengths[longest], others = reach - size;
    const glm::vec3 bone = times(all.directions[longest], size);
    Family family = all;
    family.held = longest;
    const glm::vec3 left = minus(wanted, bone);
    if (length(left) <= others) {
        Answer answer = with_all(family, minus(span, bone), left, others, near);
        answer.turns_held = false;
        return answer;
    }
    family.before = bone;
    family.line = times(all.directions[longest], -1.0f);
    family.size_straight = std::abs(size - others);
    family.size_now = length(span);
    family.wanted = length(wanted);
    return {family, fit(family, near), wanted};
}

}  // namespace

template <class Watch>
void spread(Problem& problem, Watch watch) noexcept {
    const float reach = problem.room.reach;
    const float near = std::max(0.25f * problem.tolerance, 1e-6f * reach);
    const glm::vec3 span = minus(problem.joints.back(), problem.root());
    const glm::vec3 wanted = minus(problem.target, problem.root());
    find_directions(problem);
    Family all;
    all.directions = std::span<const glm::vec3>(problem.room.old).first(problem.bones());
    all.lengths = problem.lengths();
    all.held = problem.bones();
    Answer answer = with_all(all, span, wanted, reach, near);
    const float residual = distance(problem.joints.back(), problem.target);
    if (!answer.fit.found || answer.fit.error > 0.5f * residual) {
        const Answer other = with_longest_held(all, span, wanted, reach, near);
        if (other.fit.error < answer.fit.error) answer = other;
    }
    if (!(answer.fit.error < residual)) return;
    const Rotation turn = least_turn(answer.fit.span, answer.aim);
    lay(problem, answer.family, answer.fit.t, turn, answer.turns_held, watch);
}

template void spread(Problem&, Unwatched) noexcept;
template void spread(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
