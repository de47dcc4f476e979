// Finds pairs that may come near each other, and chooses the contacts among them.
//
// Candidates are listed with a margin, and the list holds until a particle drifts too far from where it was
// listed (L. Verlet, 1967). A substep looks only at the list, and finds the same pairs however old it is.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <tuple>

#include "rope/body_contacts.hpp"
#include "rope/segments.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// Search margins for drift and for the travel in a substep, as multiples of a particle's travel and radius.
constexpr double drift_per_travel = 4.0, drift_per_radius = 0.3, reach_per_travel = 2.0,
                 reach_per_radius = 0.2;
/// Parts of a body cannot touch if they are closer than this along it, in thicknesses: pi times the radius.
constexpr double min_arc = 1.5707963267948966;
/// How fast overlapping bodies separate: part of the depth per substep, at most this many m/s.
constexpr double recovery_rate = 0.2, recovery_speed = 0.5;
/// A contact that slides past no more particles than this in a substep keeps its force.
constexpr std::uint32_t max_slide = 3;

double square(const dvec3& v) {
    return detail::dot(v, v);
}

}  // namespace

/// Calls `visit` with each particle that may collide, its list entry, and its radius in metres.
template <class Visit>
void BodyContacts::each_listed(Visit visit) const {
    for (const std::uint32_t b : Plan::part(plan_.bodies, island_.bodies)) {
        if (plan_.collides[b] == Plan::Collides::None) continue;
        const Body& body = state_.bodies[b];
        for (std::size_t i = body.first; i < body.first + body.count; ++i)
            visit(i, scratch_.listed[i], static_cast<double>(body.radius));
    }
}

/// The nearest points of two features, as weights of their particles.
BodyContacts::Nearest BodyContacts::nearest_of(const Candidate& pair, const std::array<dvec3, 4>& at) {
    if (pair.split == 2) {
        const auto found = detail::nearest_of_segments(at[0], at[1], at[2], at[3]);
        return {{found.at_a - 1.0, -found.at_a, 1.0 - found.at_b, found.at_b}, found.between};
    }
    const auto [a, b, c] = detail::nearest_of_triangle(at[0], at[1], at[2], at[3]);
    return {{-1.0, a, b, c}, (a * at[1] + b * at[2] + c * at[3]) - at[0]};
}

void BodyContacts::find() {
    search(scratch_.base);
    choose_contacts();
    warm_start();
    // Drops pairs without contact force, unless they touch on the free path.
    std::erase_if(s_.contacts, [&](const Contact& contact) {
        return contact.force == dvec3(0.0) &&
               respond(contact, points_of(contact, scratch_.base)).gap > touch_distance;
    });
    for (const Plan::Island& part : plan_.parts_of(island_))
        for (const std::uint32_t body : Plan::part(plan_.bodies, part.bodies))
            scratch_.body_group[body] = part.isolated ? body : plan_.bodies[part.bodies.first];
    for (const Contact& each : s_.contacts) join(each);
}

/// Finds pairs that may come near each other on the way to `ends`.
void BodyContacts::search(const std::vector<dvec3>& ends) {
    if (!update_drift(ends)) list_candidates();
    local_.done.work += s_.candidates.size();
    s_.pairs.clear();
    for (const Candidate& each : s_.candidates) {
        const double radii = static_cast<double>(state_.bodies[each.body_a].radius) +
                             static_cast<double>(state_.bodies[each.body_b].radius);
        // Diagonals make no contacts, but nothing may cross them.
        const bool touches = std::max(each.a, each.b) < state_.links.size();
        const double near =
            max_approach(each, &Scratch::Listed::travel) + 2.0 * path_margin + (touches ? radii : 0.0);
        if (each.listed - max_approach(each, &Scratch::Listed::drifted) > near) continue;
        const std::array<dvec3, 4> at = points_of(each, state_.position);
        const Nearest nearest = nearest_of(each, at);
        const double distance = detail::length(nearest.between);
        if (distance > near) continue;
        Pair& pair = s_.pairs.emplace_back(Pair{each});
        pair.thickness = std::max(radii, each.min_thickness);
        pair.distance = distance, pair.weights = nearest.weights;
        if (distance > 1e-9 * pair.thickness) {
            pair.normal = (1.0 / distance) * nearest.between;
            continue;
        }
        const dvec3 across = each.split == 2 ? detail::cross(at[1] - at[0], at[3] - at[2])
                                             : detail::cross(at[2] - at[1], at[3] - at[1]);
        pair.normal =
            detail::length(across) > 0.0 ? detail::unit(across) : detail::perpendicular(at[1] - at[0]);
    }
}

/// Upper bound of a pair's approach, metres: the sum of the largest moves of its two features.
double BodyContacts::max_approach(const Candidate& pair, double Scratch::Listed::*travel) const {
    double a = 0.0, b = 0.0;
    for (std::uint32_t k = 0; k < 4; ++k) {
        double& largest = k < pair.split ? a : b;
        largest = std::max(largest, scratch_.listed[pair.points[k]].*travel);
    }
    return std::sqrt(a) + std::sqrt(b);
}

/// Stores the squared drift and travel of each particle; false if candidates must be listed again.
bool BodyContacts::update_drift(const std::vector<dvec3>& ends) {
    dvec3 mean(0.0), drift(0.0);
    each_particle([&](std::size_t i) {
        mean += ends[i] - state_.position[i];
        drift += state_.position[i] - scratch_.listed[i].at;
    });
    // Motion that all particles share brings none of them closer together.
    s_.mean = (1.0 / island_.particles) * mean;
    drift = (1.0 / island_.particles) * drift;
    const std::span<const std::uint32_t> bodies = Plan::part(plan_.bodies, island_.bodies);
    bool valid = s_.listed;
    s_.radii.resize(bodies.size());
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const float radius = state_.bodies[bodies[k]].radius;
        valid = valid && radius == s_.radii[k];
        s_.radii[k] = radius;
    }
    each_listed([&](std::size_t i, Scratch::Listed& it, double) {
        it.travel = square(ends[i] - state_.position[i] - s_.mean);
        it.drifted = square(state_.position[i] - it.at - drift);
        const double max_travel = it.reach - path_margin;
        valid = valid && it.travel <= max_travel * max_travel && it.drifted <= it.max_drift * it.max_drift;
    });
    return valid;
}

/// Whether a particle moved farther than the search allowed for.
bool BodyContacts::left_search_range() {
    measure_moves();
    bool outside = false;
    each_listed([&](std::size_t, const Scratch::Listed& it, double) {
        if (outside || it.moved <= it.travel + path_margin * path_margin) return;
        const double max_move = std::sqrt(it.travel) + path_margin;
        outside = !(it.moved <= max_move * max_move);
    });
    return outside;
}

void BodyContacts::measure_moves() {
    each_listed([&](std::size_t i, Scratch::Listed& it, double) {
        it.moved = square(scratch_.x[i] - state_.position[i] - s_.mean);
    });
}

void BodyContacts::list_candidates() {
    s_.listed = true;
    s_.candidates.clear();
    s_.features.clear();
    s_.chunks.clear();
    each_listed([&](std::size_t i, Scratch::Listed& it, double radius) {
        const double travel = std::sqrt(it.travel);
        it.at = state_.position[i], it.drifted = 0.0;
        it.max_drift = drift_per_travel * travel + drift_per_radius * radius;
        it.reach = path_margin + reach_per_travel * travel + reach_per_radius * radius;
    });
    for (std::uint32_t c = island_.chunks.first; c < island_.chunks.first + island_.chunks.count; ++c)
        if (plan_.collides[plan_.chunks[c].body] != Plan::Collides::None) add_features(plan_.chunks[c]);
    std::sort(s_.chunks.begin(), s_.chunks.end(), [](const auto& c, const auto& d) {
        return std::tie(c.low.x, c.first[0]) < std::tie(d.low.x, d.first[0]);
    });
    for (std::size_t i = 0; i < s_.chunks.size(); ++i) {
        const BodyContactScratch::Chunk& c = s_.chunks[i];
        for (std::size_t j = i; j < s_.chunks.size() && s_.chunks[j].low.x <= c.high.x; ++j) {
            const BodyContactScratch::Chunk& d = s_.chunks[j];
            const bool overlap =
                c.low.y <= d.high.y && d.low.y <= c.high.y && c.low.z <= d.high.z && d.low.z <= c.high.z;
            if (overlap && plan_.collide(c.body, d.body)) search_chunks(c, d);
        }
    }
    std::sort(s_.candidates.begin(), s_.candidates.end(), [](const Candidate& p, const Candidate& q) {
        return std::tie(q.split, p.a, p.b, p.points) < std::tie(p.split, q.a, q.b, q.points);
    });
}

/// Adds the segments that begin in a chunk, its particles if it collides with cloth, and a cloth's triangles
/// and their diagonals.
void BodyContacts::add_features(const Plan::Chunk& chunk) {
    const Body& body = state_.bodies[chunk.body];
    BodyContactScratch::Chunk box{.low = dvec3(std::numeric_limits<double>::infinity()),
                                  .high = dvec3(-std::numeric_limits<double>::infinity()),
                                  .body = chunk.body};
    const auto add = [&](std::uint32_t link, std::initializer_list<std::uint32_t> points) {
        BodyContactScratch::Feature it{.body = chunk.body, .link = link};
        double reach = 0.0, max_drift = 0.0;
        for (const std::uint32_t i : points) {
            it.points[it.count++] = i;
            it.middle += (1.0 / static_cast<double>(points.size())) * state_.position[i];
            reach = std::max(reach, scratch_.listed[i].reach);
            max_drift = std::max(max_drift, scratch_.listed[i].max_drift);
        }
        double size = 0.0;
        for (const std::uint32_t i : points) size = std::max(size, square(state_.position[i] - it.middle));
        it.reach = reach + max_drift + static_cast<double>(body.radius);
        it.radius = std::sqrt(size) + it.reach;
        box.low = glm::min(box.low, it.middle - dvec3(it.radius));
        box.high = glm::max(box.high, it.middle + dvec3(it.radius));
        s_.features.push_back(it);
    };
    const auto end = [&] { return static_cast<std::uint32_t>(s_.features.size()); };
    box.first[0] = end();
    for (std::uint32_t i = chunk.first;
         plan_.collides_with_cloth[chunk.body] != 0 && i < chunk.first + chunk.count; ++i)
        add(0, {i});
    box.first[1] = end();
    for (std::uint32_t l = chunk.first_link; l < chunk.first_link + chunk.links; ++l) {
        const Link& link = state_.links[plan_.chunk_links[l]];
        add(plan_.chunk_links[l], {link.a, link.b});
    }
    const std::uint32_t last = chunk.first + chunk.count;
    const bool cloth = body.kind == Body::Kind::Cloth;
    const auto diagonal = static_cast<std::uint32_t>(state_.links.size());  // the cell bends along it
    for (std::uint32_t i = chunk.first; cloth && i < last; ++i)
        if (const std::uint32_t below = plan_.below[i]) add(diagonal + i, {i + 1, below});
    box.first[2] = end();
    for (std::uint32_t i = chunk.first; cloth && i < last; ++i) {
        const std::uint32_t below = plan_.below[i];
        if (below == 0) continue;
        add(0, {i, i + 1, below});
        add(0, {below + 1, below, i + 1});
    }
    box.first[3] = end();
    s_.chunks.push_back(box);
}

void BodyContacts::search_chunks(const BodyContactScratch::Chunk& c, const BodyContactScratch::Chunk& d) {
    const auto find_overlapping = [&](std::vector<std::uint32_t>& list, const auto& from, std::size_t kind,
                                      const auto& other) {
        list.clear();
        for (std::uint32_t f = from.first[kind]; f < from.first[kind + 1]; ++f) {
            const BodyContactScratch::Feature& it = s_.features[f];
            const dvec3 low = it.middle - dvec3(it.radius), high = it.middle + dvec3(it.radius);
            if (low.x <= other.high.x && high.x >= other.low.x && low.y <= other.high.y &&
                high.y >= other.low.y && low.z <= other.high.z && high.z >= other.low.z)
                list.push_back(f);
        }
    };
    const auto search = [&](const auto& first, std::size_t kind_a, const auto& last, std::size_t kind_b) {
        find_overlapping(s_.near_a, first, kind_a, last);
        if (s_.near_a.empty()) return;
        find_overlapping(s_.near_b, last, kind_b, first);
        for (const std::uint32_t k : s_.near_a) {
            const BodyContactScratch::Feature& a = s_.features[k];
            for (const std::uint32_t l : s_.near_b) {
                const BodyContactScratch::Feature& b = s_.features[l];
                const double reach = a.radius + b.radius;
                if (square(b.middle - a.middle) > reach * reach ||
                    (kind_a == kind_b && &first == &last && l <= k))
                    continue;
                add_candidate(a, b);
            }
        }
    };
    search(c, 1, d, 1);
    search(c, 0, d, 2);
    if (&c != &d) search(d, 0, c, 2);
}

void BodyContacts::add_candidate(const BodyContactScratch::Feature& a, const BodyContactScratch::Feature& b) {
    if (a.count == 2 && a.link > b.link) return add_candidate(b, a);
    Candidate it{.a = a.link,
                 .b = b.link,
                 .split = a.count,
                 .body_a = a.body,
                 .body_b = b.body,
                 .min_thickness = 1e-6};
    std::copy_n(a.points.begin(), a.count, it.points.begin());
    std::copy_n(b.points.begin(), b.count, it.points.begin() + a.count);
    if (a.count == 2)
        for (const BodyContactScratch::Feature* each : {&a, &b})
            it.min_thickness +=
                1e-4 * detail::length(plan_.rest_at[each->points[0]] - plan_.rest_at[each->points[1]]);
    if (a.body == b.body) {
        const double radius = state_.bodies[a.body].radius;
        const double arc = min_arc * std::max(2.0 * radius, it.min_thickness);
        for (std::uint32_t k = 0; k < a.count; ++k)
            for (std::uint32_t l = 0; l < b.count; ++l)
                if (a.points[k] == b.points[l] ||
                    square(plan_.rest_at[a.points[k]] - plan_.rest_at[b.points[l]]) < arc * arc)
                    return;
    }
    it.listed = detail::length(nearest_of(it, points_of(it, state_.position)).between);
    if (it.listed <= a.reach + b.reach) s_.candidates.push_back(it);
}

/// Whether neither segment has a neighbour that is nearer to the other segment.
bool BodyContacts::is_local_minimum(const Pair& pair) const {
    const auto is_minimum_at = [&](std::uint32_t number, double at, const dvec3& to_other) {
        const Plan::Chain& chain = plan_.chains[plan_.chain_of[number]];
        const bool first = number == chain.first_link, last = number + 1 == chain.first_link + chain.links;
        if (at >= 1.0) return last;
        if (at > 0.0 || first) return true;
        const Link& before = state_.links[number - 1];
        return detail::dot(to_other, state_.position[before.a] - state_.position[before.b]) <= 0.0;
    };
    return is_minimum_at(pair.a, -pair.weights[1], pair.normal) &&
           is_minimum_at(pair.b, pair.weights[3], -pair.normal);
}

/// Two ropes touch where their segments are nearest. On cloth, pairs of a particle and a triangle handle the
/// ends of segments, and keep diagonals apart.
void BodyContacts::choose_contacts() {
    s_.contacts.clear();
    s_.projected.clear();
    for (const Pair& pair : s_.pairs) {
        const auto is_cloth = [&](std::uint32_t body) {
            return state_.bodies[body].kind == Body::Kind::Cloth;
        };
        const bool inside =
            std::none_of(pair.weights.begin(), pair.weights.end(), [](double share) { return share == 0.0; });
        const bool cloth = is_cloth(pair.body_a) || is_cloth(pair.body_b);
        if (std::max(pair.a, pair.b) >= state_.links.size()) continue;  // a diagonal makes no contact
        if (pair.split == 2 && !(cloth ? inside : is_local_minimum(pair))) continue;
        const bool solved = !cloth && plan_.collides[pair.body_a] == Plan::Collides::Solved &&
                            plan_.collides[pair.body_b] == Plan::Collides::Solved;
        Contact& contact = (solved ? s_.contacts : s_.projected).emplace_back(Contact{pair});
        const double gap = pair.distance - pair.thickness;
        contact.target = gap < 0.0 ? gap + std::min(-recovery_rate * gap, recovery_speed * h_) : 0.0;
    }
}

/// Starts each contact with its force of the previous substep or, if it has slid, a neighbour's.
void BodyContacts::warm_start() {
    const std::vector<BodyContact>& before = state_.contacts;
    s_.reused.assign(before.size(), 0);
    const auto key = [](const BodyContact& each) { return std::tie(each.a, each.b); };
    const auto particles = [&](const Contact& contact) {
        return std::pair(state_.links[contact.a].a, state_.links[contact.b].a);
    };
    const auto take = [&](Contact& contact, std::size_t old) {
        s_.reused[old] = 1;
        contact.force = (h_ * h_) * before[old].force;
    };
    const auto first_from = [&](std::uint32_t a, std::uint32_t b) {
        const auto at =
            std::lower_bound(before.begin(), before.end(), std::tie(a, b),
                             [&](const BodyContact& each, const auto& k) { return key(each) < k; });
        return static_cast<std::size_t>(at - before.begin());
    };
    for (Contact& contact : s_.contacts) {
        const auto [a, b] = particles(contact);
        const std::size_t at = first_from(a, b);
        if (at < before.size() && before[at].a == a && before[at].b == b) take(contact, at);
    }
    for (Contact& contact : s_.contacts) {
        if (contact.force != dvec3(0.0)) continue;
        const auto [a, b] = particles(contact);
        const std::uint32_t low = a - std::min(a, max_slide);
        for (std::size_t at = first_from(low, 0); at < before.size() && before[at].a <= a + max_slide; ++at) {
            const std::uint32_t slid = std::max(before[at].b, b) - std::min(before[at].b, b);
            if (s_.reused[at] != 0 || slid > max_slide) continue;
            take(contact, at);
            break;
        }
    }
}

}  // namespace tendril::rope
