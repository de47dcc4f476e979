// The final check: nothing crosses in a substep.
#include <algorithm>
#include <cmath>
#include <limits>

#include "rope/body_contacts.hpp"
#include "rope/segments.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

constexpr int max_bisections = 6;  ///< halvings of a pair's motion
constexpr int max_separation_rounds = 8;
constexpr double restored_gap = 0.1;  ///< distance after separation, relative to the thickness
constexpr int max_step_cuts = 12;

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

/// Whether a pair crosses between two positions: no if one plane separates it at both; else bisects.
bool BodyContacts::crosses(const Candidate& pair, const Points& from, const Points& to, const dvec3& n,
                           int depth, Weights& where) const {
    if (separates(pair, n, to)) return false;
    Points halfway;
    for (std::size_t k = 0; k < 4; ++k) halfway[k] = 0.5 * (from[k] + to[k]);
    const Nearest nearest = nearest_of(pair, halfway);
    where = nearest.weights;
    const double distance = detail::length(nearest.between);
    if (depth == 0 || !(distance > 1e-12)) return true;
    return crosses(pair, from, halfway, n, depth - 1, where) ||
           crosses(pair, halfway, to, (1.0 / distance) * nearest.between, depth - 1, where);
}

bool BodyContacts::crosses(const Pair& pair, Weights& where) const {
    if (!(pair.distance > 1e-9 * pair.thickness))
        return false;  // already crossing at the start: either side will do
    const Points to = points_of(pair, scratch_.x);
    return !separates(pair, pair.normal, to) &&
           crosses(pair, points_of(pair, state_.position), to, pair.normal, max_bisections, where);
}

/// Moves the points that would cross back to their own sides.
void BodyContacts::separate(const Pair& pair, const Weights& where) {
    double freedom = 0.0, distance = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        freedom += where[k] * where[k] * scratch_.weight[pair.points[k]];
        distance += where[k] * detail::dot(pair.normal, scratch_.x[pair.points[k]]);
    }
    const double wanted = std::min(pair.distance, restored_gap * pair.thickness);
    if (!(freedom > 0.0)) return;
    join(pair);
    const double by = std::max(wanted - distance, 0.1 * wanted) / freedom;
    for (std::size_t k = 0; k < 4; ++k)
        scratch_.x[pair.points[k]] += (by * where[k] * scratch_.weight[pair.points[k]]) * pair.normal;
}

void BodyContacts::prevent_crossing() {
    if (left_search_range()) search(scratch_.x);
    Weights where{};
    bool any = true;
    for (int round = 0; any && round < max_separation_rounds; ++round) {
        any = false;
        for (const Pair& pair : s_.pairs) {
            if (!crosses(pair, where)) continue;
            any = true;
            if (round == 0) ++local_.done.held_back;
            separate(pair, where);
        }
        if (any && left_search_range()) search(scratch_.x);
    }
    if (!any) return;
    // Cuts the step of bodies that would still cross, and of those near them: a pair that does not cross in a
    // whole step does not cross in part of it.
    for (const Pair& pair : s_.pairs) join(pair);
    sort_members();
    for (int i = 0; i <= max_step_cuts; ++i) {
        const double factor = i < max_step_cuts ? 0.5 : 0.0;
        bool crossing = false;
        each_group([&](Group group) {
            const auto crosses_here = [&](const Pair& pair) {
                return first_of(pair.body_a) == group.front().group && crosses(pair, where);
            };
            if (std::none_of(s_.pairs.begin(), s_.pairs.end(), crosses_here)) return;
            crossing = true;
            each_particle_of(group, [&](std::size_t k) {
                scratch_.x[k] = state_.position[k] + factor * (scratch_.x[k] - state_.position[k]);
            });
        });
        if (!crossing) break;
    }
    ++local_.done.fallbacks;
}

}  // namespace tendril::rope
