#include "rope/islands.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tendril::rope::detail {
namespace {

/// Bodies that collide with nothing, and whose chains are all isolated, are merged until an island has this
/// many links: enough to fill registers, few enough to spread a large world over threads.
constexpr std::uint32_t island_links = 2048;

/// Sets of bodies joined by links or ties, identified by their first body (union-find).
class UnionFind {
  public:
    explicit UnionFind(std::size_t bodies) : parent_(bodies) {
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }
    std::uint32_t first_of(std::uint32_t body) {
        while (parent_[body] != body) body = parent_[body] = parent_[parent_[body]];
        return body;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = first_of(a), b = first_of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

/// Sorts a list by the island of each element; stable.
template <class T>
void sort_by_island(std::vector<Plan::Island>& islands, Plan::Range Plan::Island::*range,
                    std::vector<T>& list, auto island_of) {
    for (const T& each : list) ++(islands[island_of(each)].*range).count;
    std::uint32_t sum = 0;
    for (Plan::Island& island : islands) {
        Plan::Range& its = island.*range;
        its.first = sum;
        sum += std::exchange(its.count, 0);
    }
    std::vector<T> sorted(list.size());
    for (const T& each : list) {
        Plan::Range& its = islands[island_of(each)].*range;
        sorted[its.first + its.count++] = each;
    }
    list = std::move(sorted);
}

template <class Visit>
void each_collision(const Plan& plan, Visit visit) {
    for (std::uint32_t b = 0; b + 1 < plan.collides_first.size(); ++b)
        for (std::uint32_t m = plan.collides_first[b]; m < plan.collides_first[b + 1]; ++m)
            visit(b, plan.collides_with[m]);
}

/// Makes the islands, ignoring collisions with cloth; returns the island of each body.
std::vector<std::uint32_t> make_islands(const State& state, const std::vector<std::uint32_t>& body_of,
                                        Plan& plan) {
    const std::size_t bodies = state.bodies.size();
    UnionFind joined(bodies);
    std::vector<std::uint32_t> links(bodies, 0);
    for (const Link& link : state.links) {
        joined.join(body_of[link.a], body_of[link.b]);
        ++links[body_of[link.a]];
    }
    for (const Tie& tie : state.ties) joined.join(body_of[tie.a], body_of[tie.b]);
    const auto is_cloth = [&](std::uint32_t body) { return state.bodies[body].kind == Body::Kind::Cloth; };
    each_collision(plan, [&](std::uint32_t a, std::uint32_t b) {
        if (!is_cloth(a) && !is_cloth(b)) joined.join(a, b);
    });
    std::vector<std::uint8_t> shares(bodies, 0);
    for (const Plan::Chain& chain : plan.chains)
        if (!chain.isolated) shares[joined.first_of(chain.body)] = 1;
    for (const Tie& tie : state.ties) shares[joined.first_of(body_of[tie.a])] = 1;
    for (const std::uint32_t i : plan.soft) shares[joined.first_of(body_of[state.links[i].a])] = 1;

    std::vector<std::uint8_t> collides(bodies, 0);
    each_collision(plan, [&](std::uint32_t a, std::uint32_t b) {
        collides[joined.first_of(a)] = collides[joined.first_of(b)] = 1;
    });

    std::vector<std::uint32_t> island_of(bodies, 0);
    std::uint32_t open = 0, open_links = island_links;  // the island that takes lone bodies
    for (std::uint32_t b = 0; b < bodies; ++b) {
        const std::uint32_t first = joined.first_of(b);
        if (first != b) {
            island_of[b] = island_of[first];
        } else if (shares[b] != 0 || collides[b] != 0 || open_links >= island_links) {
            island_of[b] = static_cast<std::uint32_t>(plan.islands.size());
            plan.islands.push_back({.isolated = shares[b] == 0});
            if (shares[b] == 0 && collides[b] == 0) open = island_of[b], open_links = 0;
        } else {
            island_of[b] = open;
        }
        if (shares[first] == 0 && collides[first] == 0) open_links += links[b];
        plan.islands[island_of[b]].particles += static_cast<std::uint32_t>(state.bodies[b].count);
    }
    return island_of;
}

/// Makes islands joined by collisions with cloth contiguous. Returns the first island of each island's set.
std::vector<std::uint32_t> reorder_islands(Plan& plan, std::vector<std::uint32_t>& island_of) {
    const std::size_t count = plan.islands.size();
    UnionFind joined(count);
    each_collision(plan, [&](std::uint32_t a, std::uint32_t b) { joined.join(island_of[a], island_of[b]); });
    std::vector<std::uint32_t> order(count), now(count), first(count);
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        return joined.first_of(i) < joined.first_of(j);
    });
    std::vector<Plan::Island> islands;
    for (std::uint32_t k = 0; k < count; ++k) {
        now[order[k]] = k;
        first[k] = now[joined.first_of(order[k])];
        islands.push_back(plan.islands[order[k]]);
    }
    plan.islands = std::move(islands);
    for (std::uint32_t& each : island_of) each = now[each];
    return first;
}

/// Merges joined islands into one; they become its parts.
void merge_islands(Plan& plan, const std::vector<std::uint32_t>& first,
                   const std::vector<std::uint32_t>& island_of) {
    const std::vector<Plan::Island> all = std::move(plan.islands);
    plan.islands.clear();
    std::vector<std::uint32_t> whole(all.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        const bool continues = i + 1 < all.size() && first[i + 1] == first[i];
        if (first[i] == i) {
            plan.islands.push_back(all[i]);
            if (continues) plan.islands.back().parts = {static_cast<std::uint32_t>(plan.parts.size()), 0};
        } else {
            Plan::Island& island = plan.islands.back();
            for (const auto range : {&Plan::Island::bodies, &Plan::Island::links, &Plan::Island::soft,
                                     &Plan::Island::chains, &Plan::Island::chunks, &Plan::Island::ties})
                (island.*range).count += (all[i].*range).count;
            island.particles += all[i].particles;
            island.isolated = false;
        }
        whole[i] = static_cast<std::uint32_t>(plan.islands.size()) - 1;
        if (first[i] == i && !continues) continue;
        plan.parts.push_back(all[i]);
        ++plan.islands.back().parts.count;
    }
    each_collision(plan, [&](std::uint32_t a, std::uint32_t) {
        std::uint32_t& number = plan.islands[whole[island_of[a]]].contacts;
        if (number == 0) number = ++plan.colliding;
    });
    for (const Plan::Island& island : plan.islands)
        for (std::uint32_t k = 0; k < island.parts.count; ++k)
            plan.parts[island.parts.first + k].contacts = island.contacts;
    plan.each_part([&](const Plan::Island& island) {
        for (const std::uint32_t body : Plan::part(plan.bodies, island.bodies))
            if (!island.isolated && !plan.collides.empty() && plan.collides[body] == Plan::Collides::Solved)
                plan.collides[body] = Plan::Collides::Projected;
    });
}

}  // namespace

std::vector<std::uint32_t> bodies_of_particles(const State& state) {
    std::vector<std::uint32_t> body_of;
    body_of.reserve(state.position.size());
    for (std::uint32_t b = 0; b < state.bodies.size(); ++b)
        body_of.insert(body_of.end(), state.bodies[b].count, b);
    return body_of;
}

void divide_into_islands(const State& state, Plan& plan) {
    const std::vector<std::uint32_t> body_of = bodies_of_particles(state);
    std::vector<std::uint32_t> island_of = make_islands(state, body_of, plan);
    const std::vector<std::uint32_t> first = reorder_islands(plan, island_of);
    const auto of_body = [&](std::uint32_t body) { return island_of[body]; };
    const auto of_link = [&](std::uint32_t i) { return island_of[body_of[state.links[i].a]]; };
    plan.bodies.resize(state.bodies.size());
    std::iota(plan.bodies.begin(), plan.bodies.end(), std::uint32_t{0});
    plan.links.resize(state.links.size());
    std::iota(plan.links.begin(), plan.links.end(), std::uint32_t{0});
    std::vector<Plan::Island>& islands = plan.islands;
    sort_by_island(islands, &Plan::Island::bodies, plan.bodies, of_body);
    sort_by_island(islands, &Plan::Island::links, plan.links, of_link);
    sort_by_island(islands, &Plan::Island::soft, plan.soft, of_link);
    plan.ties.resize(state.ties.size());
    std::iota(plan.ties.begin(), plan.ties.end(), std::uint32_t{0});
    sort_by_island(islands, &Plan::Island::ties, plan.ties,
                   [&](std::uint32_t i) { return island_of[body_of[state.ties[i].a]]; });
    const auto of_part = [&](const auto& part) { return island_of[part.body]; };
    sort_by_island(islands, &Plan::Island::chains, plan.chains, of_part);
    sort_by_island(islands, &Plan::Island::chunks, plan.chunks, of_part);
    merge_islands(plan, first, island_of);
}

}  // namespace tendril::rope::detail
