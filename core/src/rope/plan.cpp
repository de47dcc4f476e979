#include "rope/plan.hpp"

#include <algorithm>

namespace tendril::rope {
namespace {

constexpr std::uint32_t chunk_size = 32;

/// How many links touch each particle.
std::vector<std::uint32_t> count_links(const State& state) {
    std::vector<std::uint32_t> touching(state.position.size(), 0);
    for (const Link& link : state.links) ++touching[link.a], ++touching[link.b];
    return touching;
}

bool follows(const Link& before, const Link& link) {
    return link.a == before.b && link.kind == before.kind;
}

}  // namespace

World::Plan::Plan(const State& state) {
    const std::vector<std::uint32_t> touching = count_links(state);
    for (std::uint32_t i = 0; i < state.links.size();) {
        const Link& first = state.links[i];
        if (first.kind != Link::Kind::Stretch) {
            soft.push_back(i++);
            continue;
        }
        Run run{.first_link = i, .links = 1, .first_node = static_cast<std::uint32_t>(nodes.size())};
        nodes.push_back(first.a);
        nodes.push_back(first.b);
        while (i + run.links < state.links.size() &&
               follows(state.links[i + run.links - 1], state.links[i + run.links])) {
            nodes.push_back(state.links[i + run.links].b);
            ++run.links;
        }
        run.alone = true;
        for (std::uint32_t k = 0; k <= run.links; ++k) {
            const std::uint32_t own = k == 0 || k == run.links ? 1 : 2;
            run.alone = run.alone && touching[nodes[run.first_node + k]] == own;
        }
        i += run.links;
        longest = std::max(longest, run.links);
        runs.push_back(run);
    }
    group_runs(state.position.size());
    cut_into_chunks(state);
    name_bodies(state);
    all_alone =
        soft.empty() && std::all_of(runs.begin(), runs.end(), [](const Run& run) { return run.alone; });
    tears =
        std::any_of(state.bodies.begin(), state.bodies.end(), [](const Body& b) { return b.tear > 0.0f; });
}

void World::Plan::group_runs(std::size_t particles) {
    std::vector<std::uint32_t> taken(particles, 0);  // by the group of that number, counted from 1
    for (std::uint32_t i = 0; i < runs.size(); ++i) {
        const Run& run = runs[i];
        const auto number = static_cast<std::uint32_t>(groups.size());
        bool joins = i > 0 && runs[i - 1].links == run.links && runs[i - 1].alone == run.alone;
        for (std::uint32_t k = 0; joins && k <= run.links; ++k)
            joins = taken[nodes[run.first_node + k]] != number;
        if (!joins) groups.push_back({.first_run = i, .runs = 0, .alone = run.alone});
        ++groups.back().runs;
        for (std::uint32_t k = 0; k <= run.links; ++k)
            taken[nodes[run.first_node + k]] = static_cast<std::uint32_t>(groups.size());
    }
}

void World::Plan::name_bodies(const State& state) {
    for (Run& run : runs) {
        const auto after = std::upper_bound(state.bodies.begin(), state.bodies.end(), nodes[run.first_node],
                                            [](std::uint32_t i, const Body& body) { return i < body.first; });
        run.body = static_cast<std::uint32_t>(after - state.bodies.begin()) - 1;
    }
}

void World::Plan::cut_into_chunks(const State& state) {
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
