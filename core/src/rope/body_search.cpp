// Finds segments that may come near each other, and which of them are contacts.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "rope/body_contacts.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// How far a particle may be pulled off its free path, metres: the collider's search allows the same.
constexpr double off_path = 1e-3;
/// Parts of a rope nearer along it, in thicknesses, cannot touch: pi times the radius.
constexpr double min_arc = 1.5707963267948966;
/// Metres above a surface that count as touching.
constexpr double nearly = 1e-5;
/// How fast what is pressed into each other comes out: a part per substep, and m/s.
constexpr double recovered = 0.2, recovery_speed = 0.5;
/// Particles that a contact may slide along in a substep and still continue.
constexpr std::uint32_t max_slide = 3;

double thickness_of(const State& state, const Plan& plan, std::uint32_t a, std::uint32_t b) {
    const auto radius = [&](std::uint32_t link) {
        return static_cast<double>(state.bodies[plan.chains[plan.chain_of[link]].body].radius);
    };
    const double rests = static_cast<double>(state.links[a].rest) + state.links[b].rest;
    return std::max({radius(a) + radius(b), 1e-4 * rests, 1e-6});
}

}  // namespace

void BodyContacts::find() {
    search(scratch_.base);
    choose_contacts();
    continue_forces();
    // What neither presses nor would needs no contact.
    std::erase_if(s_.contacts, [&](const Contact& contact) {
        return contact.force == dvec3(0.0) &&
               respond(contact, ends_of(contact.a, contact.b, scratch_.base)).gap > nearly;
    });
}

/// Finds pairs that may come near each other on the way to `ends`.
void BodyContacts::search(const std::vector<dvec3>& ends) {
    s_.pairs.clear();
    bound_chunks(ends);
    for (std::size_t i = 0; i < s_.chunks.size(); ++i) {
        const std::uint32_t c = s_.chunks[i];
        search_chunks(c, c);
        for (std::size_t j = i + 1; j < s_.chunks.size(); ++j) {
            const std::uint32_t d = s_.chunks[j];
            if (s_.low[d].x > s_.high[c].x) break;
            const bool overlap = s_.low[c].y <= s_.high[d].y && s_.low[d].y <= s_.high[c].y &&
                                 s_.low[c].z <= s_.high[d].z && s_.low[d].z <= s_.high[c].z;
            if (overlap) search_chunks(std::min(c, d), std::max(c, d));
        }
    }
    std::sort(s_.pairs.begin(), s_.pairs.end(),
              [](const Pair& p, const Pair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
}

void BodyContacts::bound_chunks(const std::vector<dvec3>& ends) {
    // What all do together brings nothing nearer.
    dvec3 mean(0.0);
    each_particle([&](std::size_t i) { mean += ends[i] - state_.position[i]; });
    s_.mean = (1.0 / island_.particles) * mean;
    const std::uint32_t first = island_.chunks.first, count = island_.chunks.count;
    s_.low.resize(plan_.chunks.size()), s_.high.resize(plan_.chunks.size());
    s_.reach.resize(plan_.chunks.size()), s_.length.resize(plan_.chunks.size());
    s_.balls.resize(plan_.chunk_links.size());
    s_.chunks.clear();
    for (std::uint32_t c = first; c < first + count; ++c) {
        const Plan::Chunk& chunk = plan_.chunks[c];
        if (plan_.collides[chunk.body] == 0 || chunk.links == 0) continue;
        s_.chunks.push_back(c);
        s_.reach[c] = s_.length[c] = 0.0;
        for (std::uint32_t l = chunk.first_link; l < chunk.first_link + chunk.links; ++l) {
            const Link& link = state_.links[plan_.chunk_links[l]];
            const dvec3 a = state_.position[link.a], b = state_.position[link.b];
            const double way = std::max(detail::length(ends[link.a] - a - s_.mean),
                                        detail::length(ends[link.b] - b - s_.mean));
            BodyContactScratch::Ball& ball = s_.balls[l];
            ball.link = plan_.chunk_links[l];
            ball.middle = 0.5 * (a + b);
            const double length = detail::length(b - a);
            ball.reach = way + off_path + static_cast<double>(state_.bodies[chunk.body].radius);
            ball.radius = 0.5 * length + ball.reach;
            s_.length[c] += length;
            s_.reach[c] = std::max(s_.reach[c], ball.reach);
            const dvec3 low = ball.middle - dvec3(ball.radius), high = ball.middle + dvec3(ball.radius);
            const bool begins = l == chunk.first_link;
            for (int k = 0; k < 3; ++k) {
                s_.low[c][k] = begins ? low[k] : std::min(s_.low[c][k], low[k]);
                s_.high[c][k] = begins ? high[k] : std::max(s_.high[c][k], high[k]);
            }
        }
    }
    std::sort(s_.chunks.begin(), s_.chunks.end(), [&](std::uint32_t c, std::uint32_t d) {
        return s_.low[c].x != s_.low[d].x ? s_.low[c].x < s_.low[d].x : c < d;
    });
}

/// False if two successive chunks of a rope, or one with itself, are too straight for that.
bool BodyContacts::may_meet(std::uint32_t c, std::uint32_t d) const {
    const Plan::Chunk &first = plan_.chunks[c], &last = plan_.chunks[d];
    if (!plan_.collide(first.body, last.body)) return false;
    if (first.body != last.body || d - c > 1) return true;
    const std::uint32_t from = plan_.chunk_links[first.first_link];
    const std::uint32_t to = plan_.chunk_links[last.first_link + last.links - 1];
    if (plan_.chain_of[from] != plan_.chain_of[to]) return true;
    const double chord =
        detail::length(state_.position[state_.links[to].b] - state_.position[state_.links[from].a]);
    const double length = s_.length[c] + (c == d ? 0.0 : s_.length[d]);
    // Two points that far apart along it are at least that far apart.
    const double arc = min_arc * thickness_of(state_, plan_, from, to);
    return chord - length + arc <= s_.reach[c] + s_.reach[d];
}

void BodyContacts::search_chunks(std::uint32_t c, std::uint32_t d) {
    if (!may_meet(c, d)) return;
    const Plan::Chunk &first = plan_.chunks[c], &last = plan_.chunks[d];
    local_.done.work += first.links;
    for (std::uint32_t k = 0; k < first.links; ++k) {
        const BodyContactScratch::Ball& a = s_.balls[first.first_link + k];
        for (std::uint32_t l = c == d ? k + 1 : 0; l < last.links; ++l) {
            const BodyContactScratch::Ball& b = s_.balls[last.first_link + l];
            const dvec3 between = b.middle - a.middle;
            const double reach = a.radius + b.radius;
            if (detail::dot(between, between) <= reach * reach) consider(a, b);
        }
    }
}

void BodyContacts::consider(const BodyContactScratch::Ball& a, const BodyContactScratch::Ball& b) {
    const double thickness = thickness_of(state_, plan_, a.link, b.link);
    if (plan_.chain_of[a.link] == plan_.chain_of[b.link]) {
        const std::uint32_t first = std::min(a.link, b.link), last = std::max(a.link, b.link);
        const double arc = plan_.arc[last] - plan_.arc[first] - state_.links[first].rest;
        if (last == first + 1 || arc < min_arc * thickness) return;
    }
    if (a.link > b.link) return consider(b, a);
    const Ends at = ends_of(a.link, b.link, state_.position);
    const auto nearest = detail::nearest_of_segments(at.a0, at.a1, at.b0, at.b1);
    Pair pair{.a = a.link, .b = b.link, .apart = detail::length(nearest.between), .thickness = thickness};
    if (pair.apart > a.reach + b.reach) return;
    pair.at_a = nearest.at_a, pair.at_b = nearest.at_b;
    if (pair.apart > 1e-9 * thickness) {
        pair.normal = (1.0 / pair.apart) * nearest.between;
    } else {
        const dvec3 across = detail::cross(at.a1 - at.a0, at.b1 - at.b0);
        pair.normal =
            detail::length(across) > 0.0 ? detail::unit(across) : detail::perpendicular(at.a1 - at.a0);
    }
    s_.pairs.push_back(pair);
}

/// Whether no neighbour of one of its segments is nearer to the other.
bool BodyContacts::lowest(const Pair& pair) const {
    const auto lowest_at = [&](std::uint32_t number, double at, const dvec3& to_other) {
        const Plan::Chain& chain = plan_.chains[plan_.chain_of[number]];
        const bool first = number == chain.first_link, last = number + 1 == chain.first_link + chain.links;
        if (at >= 1.0) return last;
        if (at > 0.0 || first) return true;
        const Link& before = state_.links[number - 1];
        return detail::dot(to_other, state_.position[before.a] - state_.position[before.b]) <= 0.0;
    };
    return lowest_at(pair.a, pair.at_a, pair.normal) && lowest_at(pair.b, pair.at_b, -pair.normal);
}

void BodyContacts::choose_contacts() {
    s_.contacts.clear();
    for (std::uint32_t p = 0; p < s_.pairs.size(); ++p) {
        const Pair& pair = s_.pairs[p];
        if (!lowest(pair)) continue;
        const double gap = pair.apart - pair.thickness;
        const double target = gap < 0.0 ? gap + std::min(-recovered * gap, recovery_speed * h_) : 0.0;
        s_.contacts.push_back(
            {.a = pair.a, .b = pair.b, .start = pair.normal, .thickness = pair.thickness, .target = target});
    }
}

/// Takes over the forces of the previous substep: of the same two segments, or of neighbours if it has slid.
void BodyContacts::continue_forces() {
    const std::vector<BodyContact>& before = state_.contacts;
    s_.taken.assign(before.size(), 0);
    const auto key = [](const BodyContact& each) { return std::tie(each.a, each.b); };
    const auto particles = [&](const Contact& contact) {
        return std::pair(state_.links[contact.a].a, state_.links[contact.b].a);
    };
    const auto take = [&](Contact& contact, std::size_t old) {
        s_.taken[old] = 1;
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
            if (s_.taken[at] != 0 || slid > max_slide) continue;
            take(contact, at);
            break;
        }
    }
}

}  // namespace tendril::rope
