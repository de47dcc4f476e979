// The final check: nothing crosses in a substep.
#include <algorithm>
#include <cmath>
#include <limits>

#include "rope/body_contacts.hpp"
#include "rope/segments.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

constexpr int max_halvings_of_way = 6;  ///< of a pair's way, to check its parts
constexpr int max_partings = 8;         ///< rounds
constexpr double parted = 0.1;          ///< distance to restore, relative to the thickness
constexpr int max_shortenings = 12;

/// Whether a plane with this normal separates a pair's features.
bool separates(const BodyContactScratch::Candidate& pair, const dvec3& n, const std::array<dvec3, 4>& at) {
    double a = -std::numeric_limits<double>::infinity(), b = -a;
    for (std::uint32_t k = 0; k < 4; ++k) {
        const double height = detail::dot(n, at[k]);
        if (k < pair.split)
            a = std::max(a, height);
        else
            b = std::min(b, height);
    }
    return b > a;
}

}  // namespace

/// Whether a pair crosses on a straight way. It does not if one plane separates the features at both ends of
/// the way; otherwise its halves are checked.
bool BodyContacts::crosses(const Candidate& pair, const Points& from, const Points& to, const dvec3& n,
                           int depth, Shares& where) const {
    if (separates(pair, n, to)) return false;
    Points halfway;
    for (std::size_t k = 0; k < 4; ++k) halfway[k] = 0.5 * (from[k] + to[k]);
    const Nearest nearest = nearest_of(pair, halfway);
    where = nearest.shares;
    const double apart = detail::length(nearest.between);
    if (depth == 0 || !(apart > 1e-12)) return true;
    return crosses(pair, from, halfway, n, depth - 1, where) ||
           crosses(pair, halfway, to, (1.0 / apart) * nearest.between, depth - 1, where);
}

bool BodyContacts::crosses(const Pair& pair, Shares& where) const {
    if (!(pair.apart > 1e-9 * pair.thickness)) return false;  // crossing from the start: either side will do
    const Points to = points_of(pair, scratch_.place);
    return !separates(pair, pair.normal, to) &&
           crosses(pair, points_of(pair, state_.position), to, pair.normal, max_halvings_of_way, where);
}

/// Moves the points that would cross back to their own sides.
void BodyContacts::part(const Pair& pair, const Shares& where) {
    double freedom = 0.0, apart = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        freedom += where[k] * where[k] * scratch_.weight[pair.points[k]];
        apart += where[k] * detail::dot(pair.normal, scratch_.place[pair.points[k]]);
    }
    const double wanted = std::min(pair.apart, parted * pair.thickness);
    if (!(freedom > 0.0)) return;
    const double by = std::max(wanted - apart, 0.1 * wanted) / freedom;
    for (std::size_t k = 0; k < 4; ++k)
        scratch_.place[pair.points[k]] += (by * where[k] * scratch_.weight[pair.points[k]]) * pair.normal;
}

void BodyContacts::keep_apart() {
    if (left_search_range()) search(scratch_.place);
    Shares where{};
    bool any = true;
    for (int round = 0; any && round < max_partings; ++round) {
        any = false;
        for (const Pair& pair : s_.pairs) {
            if (!crosses(pair, where)) continue;
            any = true;
            if (round == 0) ++local_.done.held_back;
            part(pair, where);
        }
        if (any && left_search_range()) search(scratch_.place);
    }
    if (!any) return;
    // All bodies go only a part of the way: pairs that did not cross on the whole way do not on a part.
    for (int i = 0; i <= max_shortenings; ++i) {
        const double left = i < max_shortenings ? 0.5 : 0.0;
        each_particle([&](std::size_t k) {
            scratch_.place[k] = state_.position[k] + left * (scratch_.place[k] - state_.position[k]);
        });
        if (std::none_of(s_.pairs.begin(), s_.pairs.end(),
                         [&](const Pair& pair) { return crosses(pair, where); }))
            break;
    }
    ++local_.done.fallbacks;
}

}  // namespace tendril::rope
