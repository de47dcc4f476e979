// The last check of a substep: no two segments may pass through each other.
#include <algorithm>
#include <cmath>

#include "rope/body_contacts.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

constexpr int max_halvings_of_way = 6;  ///< how finely a pair's way is divided to check it
constexpr int max_partings = 8;         ///< rounds of moving pairs back apart
constexpr double parted = 0.1;          ///< the gap that this leaves, relative to the thickness
constexpr int max_shortenings = 12;     ///< halvings, when they do not part

}  // namespace

/// Whether a segment moved farther than the search allowed for.
bool BodyContacts::outran() const {
    for (const std::uint32_t c : s_.chunks) {
        const Plan::Chunk& chunk = plan_.chunks[c];
        const double radius = state_.bodies[chunk.body].radius;
        for (std::uint32_t l = chunk.first_link; l < chunk.first_link + chunk.links; ++l) {
            const Link& link = state_.links[s_.balls[l].link];
            for (const std::uint32_t i : {link.a, link.b}) {
                const dvec3 way = scratch_.place[i] - state_.position[i] - s_.mean;
                const double most = s_.balls[l].reach - radius;
                if (!(detail::dot(way, way) <= most * most)) return true;
            }
        }
    }
    return false;
}

/// Whether two segments cross while their ends move straight. They do not if a plane separates them at both
/// ends of the way; if this one does not, both halves of the way are checked.
bool BodyContacts::crosses(const Ends& from, const Ends& to, const dvec3& n, int depth,
                           Crossing& where) const {
    const double a = std::max(detail::dot(n, to.a0), detail::dot(n, to.a1));
    const double b = std::min(detail::dot(n, to.b0), detail::dot(n, to.b1));
    if (b > a) return false;
    const Ends halfway{0.5 * (from.a0 + to.a0), 0.5 * (from.a1 + to.a1), 0.5 * (from.b0 + to.b0),
                       0.5 * (from.b1 + to.b1)};
    const auto nearest = detail::nearest_of_segments(halfway.a0, halfway.a1, halfway.b0, halfway.b1);
    where = {nearest.at_a, nearest.at_b};
    const double apart = detail::length(nearest.between);
    if (depth == 0 || !(apart > 1e-12)) return true;
    return crosses(from, halfway, n, depth - 1, where) ||
           crosses(halfway, to, (1.0 / apart) * nearest.between, depth - 1, where);
}

bool BodyContacts::crosses(const Pair& pair, Crossing& where) const {
    if (!(pair.apart > 1e-9 * pair.thickness)) return false;  // they began in contact: either side will do
    const Ends to = ends_of(pair.a, pair.b, scratch_.place);
    const double a = std::max(detail::dot(pair.normal, to.a0), detail::dot(pair.normal, to.a1));
    const double b = std::min(detail::dot(pair.normal, to.b0), detail::dot(pair.normal, to.b1));
    if (b > a) return false;
    return crosses(ends_of(pair.a, pair.b, state_.position), to, pair.normal, max_halvings_of_way, where);
}

/// Moves two segments that would cross back to their own sides.
void BodyContacts::part(const Pair& pair, const Crossing& where) {
    const Link &a = state_.links[pair.a], &b = state_.links[pair.b];
    const std::uint32_t particles[] = {a.a, a.b, b.a, b.b};
    const double shares[] = {where.at_a - 1.0, -where.at_a, 1.0 - where.at_b, where.at_b};
    double freedom = 0.0, apart = 0.0;
    for (int k = 0; k < 4; ++k) {
        freedom += shares[k] * shares[k] * scratch_.weight[particles[k]];
        apart += shares[k] * detail::dot(pair.normal, scratch_.place[particles[k]]);
    }
    const double wanted = std::min(pair.apart, parted * pair.thickness);
    if (!(freedom > 0.0)) return;
    const double by = std::max(wanted - apart, 0.1 * wanted) / freedom;
    for (int k = 0; k < 4; ++k)
        scratch_.place[particles[k]] += (by * shares[k] * scratch_.weight[particles[k]]) * pair.normal;
}

void BodyContacts::keep_apart() {
    if (outran()) search(scratch_.place);
    Crossing where;
    bool any = true;
    for (int round = 0; any && round < max_partings; ++round) {
        any = false;
        for (const Pair& pair : s_.pairs) {
            if (!crosses(pair, where)) continue;
            any = true;
            if (round == 0) ++local_.done.held_back;
            part(pair, where);
        }
        if (any && outran()) search(scratch_.place);
    }
    if (!any) return;
    // Shortens the way of all particles alike: pairs that did not cross on the whole way do not on a part of
    // it.
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
