// The range of targets that a chain can reach, and the closed-form poses for targets out of reach. Shared by
// chains, chains within limits and trees. Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "ik/math.hpp"
#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// The range of distances that a tip can have from the root, metres.
struct Reachability {
    double nearest = 0.0;   ///< the other bones folded back along the longest; 0 if they are longer
    double furthest = 0.0;  ///< sum of the lengths

    static Reachability of(double reach, double longest) noexcept {
        return {std::max(2.0 * longest - reach, 0.0), reach};
    }
    double clamped(double distance) const noexcept { return std::clamp(distance, nearest, furthest); }
    /// Distance of the tip from a target at `distance`, in the best pose.
    double residual(double distance) const noexcept { return std::abs(distance - clamped(distance)); }
    /// Stretched or TooClose if a target is out of reach by more than `slack`, else Converged.
    Status status(double distance, double slack) const noexcept {
        if (distance > furthest + slack) return Status::Stretched;
        return nearest > 0.0 && distance < nearest - slack ? Status::TooClose : Status::Converged;
    }
    /// Distance to which the chain extends for a target at `distance`, with a soft zone given as a fraction
    /// of the reach: with z its width, a = R - z its start and x = (D - a) / z for a target at distance D >
    /// a, it is a + z x / sqrt(1 + x^2). Slope and curvature are continuous at the start of the zone, and R
    /// is approached but never reached. Never less than the chain can fold.
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

/// The pose of a chain whose target is out of reach: calls `place(i, to)` to move each of `joints`, except
/// the first, onto one line. `length_of(i)` is the length of the bone from joint i to the next, metres.
///
/// Straightened: each joint is placed towards the target from the rounded position of the previous joint, so
/// that rounding does not add up to a bend.
template <class Length, class Place>
void straighten(std::span<const glm::vec3> joints, const glm::vec3& target, Length length_of,
                Place place) noexcept {
    glm::dvec3 along = between(joints[0], target);
    for (std::size_t i = 1; i < joints.size(); ++i) {
        along = direction_of(between(joints[i - 1], target), 0.0).value_or(along);
        place(i, moved(joints[i - 1], along, static_cast<double>(length_of(i - 1))));
    }
}

/// Folded: the longest bone points at the target and the others back. If the target is so close to the root
/// that every line gives the same residual, to a part in 500 of `nearest`, its direction is ignored:
/// following it would turn the chain about for no gain. Instead the line is the one on which the folded chain
/// lies nearest to its current pose: with c the position of each joint on it, the direction of the sum of c *
/// (joint - root).
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

/// If the target is out of reach, straightens the chain towards it (Stretched) or folds it (TooClose).
/// Otherwise returns nothing and moves nothing. Distances within a millionth of the reach are equal: that is
/// the precision of the sums in floats.
template <class Watch>
std::optional<Report> answer_beyond_reach(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
