// Which targets a chain can reach, and the poses for those that it cannot, found without iterating. Chains,
// chains within limits and trees share it. Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "ik/math.hpp"
#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Which distances from the root a tip can have, metres.
struct Reachability {
    double nearest = 0.0;   ///< where the other bones fold back along the longest; 0 where they can fold
    double furthest = 0.0;  ///< the sum of the bones

    static Reachability of(double reach, double longest) noexcept {
        return {std::max(2.0 * longest - reach, 0.0), reach};
    }
    double clamped(double distance) const noexcept { return std::clamp(distance, nearest, furthest); }
    /// How far from a target at `distance` the best pose leaves the tip.
    double residual(double distance) const noexcept { return std::abs(distance - clamped(distance)); }
    /// Stretched or TooClose where a target is out of reach by more than `slack`, else Converged.
    Status status(double distance, double slack) const noexcept {
        if (distance > furthest + slack) return Status::Stretched;
        return nearest > 0.0 && distance < nearest - slack ? Status::TooClose : Status::Converged;
    }
    /// How far out the chain goes for a target at `distance` with a soft zone, part of the reach: with z its
    /// width, a = R - z its start and x = (D - a) / z for a target at distance D > a, out to
    /// a + z x / sqrt(1 + x^2). That joins the part before the zone with the same slope and the same
    /// curvature, and comes near to R without reaching it; never nearer than the chain can fold.
    double eased(double distance, double zone) const noexcept {
        const double width = zone * furthest, start = furthest - width, beyond = distance - start;
        if (!(beyond > 0.0) || !(width > 0.0)) return distance;
        const double part = beyond / width;
        return std::max(start + beyond / std::sqrt(1.0 + part * part), std::min(distance, nearest));
    }
};

/// The distance in double, rounded once.
static inline float exact_distance(const glm::vec3& a, const glm::vec3& b) noexcept {
    return static_cast<float>(length(between(a, b)));
}

/// The pose of a chain whose target is out of reach: `joints`, of which the first stays, go by `place(i, to)`
/// onto one line. `length_of(i)` is the bone from joint i to the next, metres.
///
/// Straight: each joint straight towards the target from where the one before has really come to lie, so that
/// the roundings of many joints do not add up to a bend.
template <class Length, class Place>
void straighten(std::span<const glm::vec3> joints, const glm::vec3& target, Length length_of,
                Place place) noexcept {
    glm::dvec3 along = between(joints[0], target);
    for (std::size_t i = 1; i < joints.size(); ++i) {
        along = direction_of(between(joints[i - 1], target), 0.0).value_or(along);
        place(i, moved(joints[i - 1], along, static_cast<double>(length_of(i - 1))));
    }
}

/// Folded: the longest bone points at the target and the others back. A target so near to the root that every
/// line leaves the same residual, to a part in 500 of `nearest`, has no say in which: it would turn the chain
/// about for nothing. Then it is the line along which the folded chain lies nearest to where it is: with c
/// the place of each joint on it, the direction of the sum of c * (joint - root).
template <class Length, class Place>
void fold(std::span<const glm::vec3> joints, const glm::vec3& target, double nearest, Length length_of,
          Place place) noexcept {
    std::size_t longest = 0;
    for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
        if (length_of(i) > length_of(longest)) longest = i;
    }
    const auto signed_length = [&](std::size_t i) {
        return static_cast<double>(i == longest ? length_of(i) : -length_of(i));
    };
    glm::dvec3 along = between(joints[0], target);
    if (length(along) <= 1e-3 * nearest) {
        along = glm::dvec3(0.0);
        double c = 0.0;
        for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
            c += signed_length(i);
            along = plus(along, times(between(joints[0], joints[i + 1]), c));
        }
    }
    along = direction_of(along, 0.0).value_or(glm::dvec3(1.0, 0.0, 0.0));
    for (std::size_t i = 1; i < joints.size(); ++i)
        place(i, moved(joints[i - 1], along, signed_length(i - 1)));
}

Reachability reachability_of(const Problem& problem) noexcept;

/// Where the target is out of reach, the chain straightened towards it (Stretched) or folded (TooClose).
/// Nothing, and none is moved, where it can be reached. Distances within a millionth of the reach count as
/// equal: that is what floats leave of the sums.
template <class Watch>
std::optional<Report> answer_beyond_reach(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
