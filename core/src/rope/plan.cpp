#include "rope/plan.hpp"

#include <algorithm>

#include "rope/build.hpp"
#include "rope/cloth_plan.hpp"
#include "rope/islands.hpp"
#include "rope/rest_grid.hpp"
#include "rope/slots.hpp"

namespace tendril::rope {
namespace {

constexpr std::uint32_t chunk_size = 32;

/// The number of links at each particle.
std::vector<std::uint32_t> count_links(const State& state) {
    std::vector<std::uint32_t> touching(state.position.size(), 0);
    for (const Link& link : state.links) ++touching[link.a], ++touching[link.b];
    return touching;
}

/// Particles per row of a cloth; 0 for others.
std::size_t row_of(const Body& body) {
    return body.kind == Body::Kind::Cloth ? body.row : 0;
}

}  // namespace

Plan::Plan(const State& state) {
    find_chains(state);
    index_collisions(state);
    find_faces(state);
    cut_into_chunks(state);
    detail::divide_into_islands(state, *this);
    number_chains(state.links.size());
    detail::find_grids(state, *this);
    group_chains(state.position.size());
    order_tied(state);
    particles_ = state.position.size();
    collisions_ = state.collisions;
    joined_.reserve(state.links.size());
    for (const Link& link : state.links) joined_.push_back({link.a, link.b, link.rest, link.kind});
    for (const Tie& tie : state.ties) tied_.emplace_back(tie.a, tie.b);
    for (const Body& body : state.bodies)
        ranges_.push_back(
            {body.first, body.count, row_of(body), body.cells, body.tear > 0.0f, body.bending > 0.0f});
    tears =
        std::any_of(state.bodies.begin(), state.bodies.end(), [](const Body& b) { return b.tear > 0.0f; });
}

void Plan::find_chains(const State& state) {
    const std::vector<std::uint32_t> touching = count_links(state);
    const std::vector<std::uint32_t> body_of = detail::bodies_of_particles(state);
    for (std::uint32_t i = 0; i < state.links.size();) {
        const Link& first = state.links[i];
        if (first.kind != Link::Kind::Stretch) {
            soft.push_back(i++);
            continue;
        }
        Chain chain{.first_link = i,
                    .links = 1,
                    .first_node = static_cast<std::uint32_t>(nodes.size()),
                    .body = body_of[first.a]};
        nodes.push_back(first.a);
        nodes.push_back(first.b);
        while (i + chain.links < state.links.size() &&
               detail::follows(state.links[i + chain.links - 1], state.links[i + chain.links])) {
            nodes.push_back(state.links[i + chain.links].b);
            ++chain.links;
        }
        chain.isolated = true;
        for (std::uint32_t k = 0; k <= chain.links; ++k) {
            const std::uint32_t own = k == 0 || k == chain.links ? 1 : 2;
            chain.isolated = chain.isolated && touching[nodes[chain.first_node + k]] == own;
        }
        i += chain.links;
        longest = std::max(longest, chain.links);
        chains.push_back(chain);
    }
}

/// The surface of all bodies, for the wind. Torn cells have none.
void Plan::find_faces(const State& state) {
    const std::size_t particles = state.position.size();
    below.assign(particles, 0), faces.assign(particles, 0);
    std::vector<std::uint8_t> linked(particles, 0);  // to the next in its row
    std::vector<std::uint32_t> under(particles, 0);  // its linked particle in the next row
    const std::vector<std::uint32_t> body_of = detail::bodies_of_particles(state);
    for (const Link& link : state.links) {
        const Body& of = state.bodies[body_of[link.a]];
        if (link.kind != Link::Kind::Stretch || !detail::is_within(of, link)) continue;
        const detail::LinkStep step = detail::link_step(of, link);
        const std::uint32_t low = std::min(link.a, link.b), high = std::max(link.a, link.b);
        if (step.columns == 1 && step.rows == 0) linked[low] = 1;
        if (step.columns == 0 && step.rows == 1) under[low] = high;
    }
    for (const Body& body : state.bodies) {
        const bool cloth = body.kind == Body::Kind::Cloth;
        for (std::size_t i = body.first; i + 1 < body.first + body.count; ++i) {
            if (linked[i] == 0) continue;
            if (!cloth) {
                below[i] = static_cast<std::uint32_t>(i + 1);
                faces[i] += 1, faces[i + 1] += 1;
                continue;
            }
            const std::uint32_t down = under[i];
            if (down == 0 || under[i + 1] != down + 1 || linked[down] == 0) continue;
            below[i] = down;
            faces[i] += 1, faces[i + 1] += 2, faces[down] += 2, faces[down + 1] += 1;
        }
    }
}

bool Plan::fits(const State& state) const noexcept {
    return particles_ == state.position.size() && collisions_ == state.collisions &&
           std::equal(state.links.begin(), state.links.end(), joined_.begin(), joined_.end(),
                      [](const Link& link, const Joined& joined) {
                          return link.a == joined.a && link.b == joined.b && link.rest == joined.rest &&
                                 link.kind == joined.kind;
                      }) &&
           std::equal(state.ties.begin(), state.ties.end(), tied_.begin(), tied_.end(),
                      [](const Tie& tie, const detail::Elimination::Edge& edge) {
                          return tie.a == edge.first && tie.b == edge.second;
                      }) &&
           std::equal(state.bodies.begin(), state.bodies.end(), ranges_.begin(), ranges_.end(),
                      [](const Body& body, const Particles& range) {
                          return body.first == range.first && body.count == range.count &&
                                 row_of(body) == range.row && body.cells == range.cells &&
                                 (body.tear > 0.0f) == range.tears && (body.bending > 0.0f) == range.bends;
                      });
}

void Plan::group_chains(std::size_t particles) {
    std::vector<std::uint32_t> last_group(particles,
                                          0);  // 1-based number of the last group with the particle
    each_part([&](Island& island) {
        island.groups.first = static_cast<std::uint32_t>(groups.size());
        const std::uint32_t begin = island.chains.first, end = begin + island.chains.count;
        for (std::uint32_t i = begin; i < end; ++i) {
            const Chain& chain = chains[i];
            const auto number = static_cast<std::uint32_t>(groups.size());
            bool joins =
                i > begin && chains[i - 1].links == chain.links && chains[i - 1].isolated == chain.isolated;
            for (std::uint32_t k = 0; joins && k <= chain.links; ++k)
                joins = last_group[nodes[chain.first_node + k]] != number;
            if (!joins) groups.push_back({.first_chain = i, .chains = 0});
            ++groups.back().chains;
            for (std::uint32_t k = 0; k <= chain.links; ++k)
                last_group[nodes[chain.first_node + k]] = static_cast<std::uint32_t>(groups.size());
        }
        island.groups.count = static_cast<std::uint32_t>(groups.size()) - island.groups.first;
    });
}

void Plan::index_collisions(const State& state) {
    if (state.collisions.empty()) return;
    const auto index_of = [&](BodyId id) {
        return static_cast<std::uint32_t>(detail::find_in(state.bodies, id) - state.bodies.data());
    };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const Collision& each : state.collisions)
        pairs.push_back(std::minmax({index_of(each.a), index_of(each.b)}));
    std::sort(pairs.begin(), pairs.end());
    collides_first.assign(state.bodies.size() + 1, 0);
    for (const auto& [a, b] : pairs) ++collides_first[a + 1], collides_with.push_back(b);
    for (std::size_t b = 0; b < state.bodies.size(); ++b) collides_first[b + 1] += collides_first[b];
    collides.assign(state.bodies.size(), Collides::None);
    collides_with_cloth.assign(state.bodies.size(), 0);
    const auto add = [&](std::uint32_t body, std::uint32_t other) {
        const bool cloth = state.bodies[body].kind == Body::Kind::Cloth;
        collides[body] = cloth ? Collides::Projected : Collides::Solved;
        if (state.bodies[other].kind == Body::Kind::Cloth) collides_with_cloth[body] = 1;
    };
    for (const auto& [a, b] : pairs) add(a, b), add(b, a);
    rest_at.assign(state.position.size(), glm::dvec3(0.0));
    for (std::uint32_t b = 0; b < state.bodies.size(); ++b) {
        if (collides[b] == Collides::None) continue;
        const Body& body = state.bodies[b];
        const detail::RestGrid grid = detail::rest_grid(state, body);
        for (std::size_t i = 0; i < body.count; ++i) {
            const std::size_t cell = body.cell(i);
            rest_at[body.first + i] = grid.at(cell % body.row, cell / body.row);
        }
    }
}

/// Call once the chains are in the order of their islands.
void Plan::number_chains(std::size_t count) {
    if (collides_first.empty()) return;
    chain_of.assign(count, 0);
    for (std::uint32_t c = 0; c < chains.size(); ++c)
        std::fill_n(chain_of.begin() + chains[c].first_link, chains[c].links, c);
}

bool Plan::collide(std::uint32_t body_a, std::uint32_t body_b) const noexcept {
    const auto pair = std::minmax(body_a, body_b);
    const auto first = collides_with.begin() + collides_first[pair.first];
    return std::binary_search(first, collides_with.begin() + collides_first[pair.first + 1], pair.second);
}

void Plan::order_tied(const State& state) {
    if (state.ties.empty()) return;
    system_index.resize(state.position.size());
    each_part([&](Island& island) {
        if (island.ties.count == 0) return;
        Tied& made = tied[island.tied - 1];
        std::vector<std::size_t> nodes_of_it;  // particles
        std::vector<std::uint8_t> in_grid(state.position.size(), 0);
        for (const std::uint32_t body : part(bodies, island.bodies)) {
            const Body& of = state.bodies[body];
            const std::uint32_t grid = grid_of[body];
            for (std::size_t i = 0; i < of.count; ++i) {
                const std::size_t particle = of.first + i;
                if (grid > 0) {
                    in_grid[particle] = 1;
                    system_index[particle] = grid_cells[grids[grid - 1].cells.first + i];
                } else {
                    system_index[particle] = static_cast<std::uint32_t>(nodes_of_it.size());
                    nodes_of_it.push_back(particle);
                }
            }
        }
        std::vector<detail::Elimination::Edge> edges;
        const auto join = [&](std::uint32_t a, std::uint32_t b) {
            if (in_grid[a] + in_grid[b] == 0) edges.emplace_back(system_index[a], system_index[b]);
        };
        for (const std::uint32_t i : part(links, island.links)) join(state.links[i].a, state.links[i].b);
        for (const Chain& chain : part(chains, island.chains))
            for (std::uint32_t k = 1; state.bodies[chain.body].bending > 0.0f && k < chain.links; ++k) {
                const std::uint32_t* const node = &nodes[chain.first_node + k];
                made.bends.push_back({{node[-1], node[0], node[1]}, chain.first_link + k, chain.body, {}});
                join(node[-1], node[1]);
            }
        std::vector<std::uint8_t> late(nodes_of_it.size(), 0);
        for (const std::uint32_t i : part(ties, island.ties)) {
            const Tie& tie = state.ties[i];
            join(tie.a, tie.b);
            if (in_grid[tie.a] + in_grid[tie.b] == 0) continue;
            made.across.push_back(i);
            for (const std::uint32_t end : {tie.a, tie.b})
                if (in_grid[end] == 0) late[system_index[end]] = 1;
        }
        made.order = detail::Elimination(late, edges);
        for (std::size_t node = 0; node < nodes_of_it.size(); ++node)
            system_index[nodes_of_it[node]] = made.order.rank[node];
        const auto block = [&](std::uint32_t a, std::uint32_t b) {
            return in_grid[a] + in_grid[b] > 0 ? no_block
                                               : made.order.block(system_index[a], system_index[b]);
        };
        for (const std::uint32_t i : part(links, island.links))
            made.link_blocks.push_back(block(state.links[i].a, state.links[i].b));
        for (Tied::Bend& bend : made.bends)
            bend.blocks = {block(bend.points[0], bend.points[1]), block(bend.points[1], bend.points[2]),
                           block(bend.points[0], bend.points[2])};
        for (const std::uint32_t i : part(ties, island.ties))
            made.tie_blocks.push_back(block(state.ties[i].a, state.ties[i].b));
    });
}

void Plan::cut_into_chunks(const State& state) {
    for (std::uint32_t b = 0; b < state.bodies.size(); ++b) {
        const Body& body = state.bodies[b];
        for (std::size_t at = 0; at < body.count; at += chunk_size) {
            chunks.push_back(
                {.first = static_cast<std::uint32_t>(body.first + at),
                 .count = static_cast<std::uint32_t>(std::min<std::size_t>(chunk_size, body.count - at)),
                 .body = b});
        }
    }
    // Stretch links by the chunk that they begin in.
    std::vector<std::uint32_t> chunk_of(state.position.size(), 0);
    for (std::uint32_t c = 0; c < chunks.size(); ++c)
        for (std::uint32_t i = 0; i < chunks[c].count; ++i) chunk_of[chunks[c].first + i] = c;
    std::vector<std::uint32_t> fill(chunks.size(), 0);
    for (const Link& link : state.links)
        if (link.kind == Link::Kind::Stretch) ++chunks[chunk_of[link.a]].links;
    std::uint32_t sum = 0;
    for (Chunk& chunk : chunks) {
        chunk.first_link = sum;
        sum += chunk.links;
    }
    chunk_links.resize(sum);
    for (std::uint32_t i = 0; i < state.links.size(); ++i) {
        if (state.links[i].kind != Link::Kind::Stretch) continue;
        const std::uint32_t c = chunk_of[state.links[i].a];
        chunk_links[chunks[c].first_link + fill[c]++] = i;
        chunks[c].reach = std::max(chunks[c].reach, state.links[i].rest);
    }
}

}  // namespace tendril::rope
