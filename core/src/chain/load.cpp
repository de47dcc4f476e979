// Loads many segments at once: a saved chain is restored bit for bit, a hand-written or damaged one is
// recalculated.
#include <algorithm>
#include <limits>
#include <utility>

#include "chain/checks.hpp"
#include "chain/pull.hpp"
#include "math/vector.hpp"
#include "tendril/chain/chain.hpp"

namespace tendril {
namespace {

/// Tolerance of a bone's length. Within 1e3 m it is the invariant's. Further out, rounding a placed point
/// costs up to half the spacing of floats per axis, up to 0.87 of the spacing in total.
double allowed_error(const glm::vec3& from, const Segment& to) {
    const double allowed = 1e-4 * std::max(1.0, static_cast<double>(to.length));
    const double furthest =
        std::max<double>(math::largest_coordinate(from), math::largest_coordinate(to.position));
    if (furthest <= 1e3) return allowed;
    return allowed + furthest * static_cast<double>(std::numeric_limits<float>::epsilon());
}

bool has_length(const glm::vec3& from, const Segment& to) {
    const double x = static_cast<double>(to.position.x) - static_cast<double>(from.x);
    const double y = static_cast<double>(to.position.y) - static_cast<double>(from.y);
    const double z = static_cast<double>(to.position.z) - static_cast<double>(from.z);
    const double distance = std::sqrt(x * x + y * y + z * z);  // in double: far out, a float is too coarse
    return std::abs(distance - static_cast<double>(to.length)) <= allowed_error(from, to);
}

/// The first segment that is not at its length from the previous one, or the number of segments.
std::size_t first_loose(std::span<const Segment> segments) {
    std::size_t i = 1;
    while (i < segments.size() && has_length(segments[i - 1].position, segments[i])) ++i;
    return std::min(i, segments.size());
}

/// Pulls towards the tail, from segment `first` on. A segment given at its predecessor's position continues
/// straight on.
void recalculate_from(std::span<Segment> segments, std::size_t first, const glm::vec3& fallback) {
    if (first >= segments.size()) return;
    glm::vec3 given_before = segments[first - 1].position;
    for (std::size_t i = first; i < segments.size(); ++i) {
        const glm::vec3 anchor = segments[i - 1].position;
        const glm::vec3 given = segments[i].position;
        if (detail::coincide(given_before, given)) {
            const glm::vec3 along =
                i > 1 ? detail::direction(segments[i - 2].position, anchor, fallback) : fallback;
            segments[i].position = detail::moved(anchor, along, segments[i].length);
        } else {
            segments[i].position = detail::step(anchor, given, segments[i].length, fallback);
        }
        given_before = given;
    }
}

}  // namespace

Expected<Chain> Chain::from_segments(std::vector<Segment> segments, glm::vec3 default_direction) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (detail::is_point(segments[i].position) && detail::is_length(segments[i].length)) continue;
        return detail::check_segment("from_segments", {"segments", i}, segments[i]);
    }
    Chain chain;
    if (const Result bad = chain.set_default_direction(default_direction); !bad) return bad;
    chain.segments_ = std::move(segments);
    recalculate_from(chain.segments_, first_loose(chain.segments_), chain.default_direction_);
    return chain;
}

Result Chain::set_positions(std::span<const glm::vec3> positions) {
    if (const Result bad = detail::check_count("set_positions", "positions", positions.size(), size());
        !bad) {
        return bad;
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (detail::is_point(positions[i])) continue;
        return detail::check_point("set_positions", {"positions", i}, positions[i]);
    }
    for (std::size_t i = 0; i < positions.size(); ++i) segments_[i].position = positions[i];
    recalculate_from(segments_, first_loose(segments_), default_direction_);
    return {};
}

}  // namespace tendril
