#include "rope/cloth_plan.hpp"

#include <algorithm>

#include "rope/grid_system.hpp"
#include "rope/rest_grid.hpp"

namespace tendril::rope::detail {
namespace {

/// Finds the cell and the step of a link in a grid; false if it is not a grid link.
bool place_in_grid(const Body& body, const Link& link, std::size_t stride, Plan::GridLink& in_grid) {
    const LinkStep step = link_step(body, link);
    for (std::size_t s = 0; s < grid_steps.size(); ++s) {
        if (grid_steps[s].column != step.columns || grid_steps[s].row != step.rows) continue;
        in_grid.cell = static_cast<std::uint32_t>(step.row * stride + step.column);
        in_grid.step = static_cast<std::uint32_t>(s);
        return true;
    }
    return false;
}

/// Adds a body's grid if it holds each of the body's links exactly once; otherwise returns false.
bool fill_grid(const State& state, const Plan::Island& island, std::uint32_t number, Plan& plan) {
    const Body& body = state.bodies[number];
    if (body.kind != Body::Kind::Cloth || body.row < 2) return false;
    if (body.rows() < 2 || body.row * body.rows() > 16 * body.count + 64) return false;  // mostly gaps
    Plan::Grid grid{.body = number,
                    .columns = static_cast<std::uint32_t>(body.row),
                    .rows = static_cast<std::uint32_t>(body.rows()),
                    .links = {static_cast<std::uint32_t>(plan.grid_links.size()), 0},
                    .cells = {static_cast<std::uint32_t>(plan.grid_cells.size()),
                              static_cast<std::uint32_t>(body.count)}};
    const std::size_t stride = grid_stride(body.row);
    std::vector<std::uint8_t> taken(stride * grid.rows, 0);  // a bit per step
    const auto of_body = [&](std::uint32_t particle) { return particle - body.first < body.count; };
    for (const std::uint32_t i : Plan::part(plan.links, island.links)) {
        const int ends = (of_body(state.links[i].a) ? 1 : 0) + (of_body(state.links[i].b) ? 1 : 0);
        if (ends == 0) continue;
        Plan::GridLink link{.link = i};
        const bool fits = ends == 2 && place_in_grid(body, state.links[i], stride, link);
        const auto bit = static_cast<std::uint8_t>(1u << link.step);
        if (!fits || (taken[link.cell] & bit) != 0) {
            plan.grid_links.resize(grid.links.first);
            return false;
        }
        taken[link.cell] = static_cast<std::uint8_t>(taken[link.cell] | bit);
        plan.grid_links.push_back(link);
        ++grid.links.count;
    }
    for (std::size_t i = 0; i < body.count; ++i) {
        const std::size_t cell = body.cell(i);
        plan.grid_cells.push_back(static_cast<std::uint32_t>(cell / body.row * stride + cell % body.row));
    }
    plan.grids.push_back(grid);
    plan.grid_of[number] = static_cast<std::uint32_t>(plan.grids.size());
    return true;
}

/// Solving for ties of grids costs the cube of their number, elimination the cube of a cloth's side. With
/// more ties than this per particle of a side, elimination costs less.
constexpr std::size_t max_ties_per_side = 4;

/// Adds the grids of tied bodies, unless there are so many ties that elimination costs less.
void fill_tied_grids(const State& state, Plan::Island& island, Plan& plan) {
    Plan::Range& grids = plan.tied.emplace_back().grids;
    island.tied = static_cast<std::uint32_t>(plan.tied.size());
    grids.first = static_cast<std::uint32_t>(plan.grids.size());
    const std::size_t links = plan.grid_links.size(), all_cells = plan.grid_cells.size();
    std::size_t cells = 0, ties = 0;
    for (const std::uint32_t body : Plan::part(plan.bodies, island.bodies)) {
        if (!fill_grid(state, island, body, plan)) continue;
        ++grids.count;
        cells += state.bodies[body].count;
    }
    for (const Plan::Grid& grid : Plan::part(plan.grids, grids)) {
        const Body& body = state.bodies[grid.body];
        for (const std::uint32_t i : Plan::part(plan.ties, island.ties))
            for (const std::uint32_t end : {state.ties[i].a, state.ties[i].b})
                ties += end - body.first < body.count ? 1 : 0;
    }
    if (ties * ties <= max_ties_per_side * max_ties_per_side * cells) return;
    for (const Plan::Grid& grid : Plan::part(plan.grids, grids)) plan.grid_of[grid.body] = 0;
    plan.grids.resize(grids.first);
    plan.grid_links.resize(links);
    plan.grid_cells.resize(all_cells);
    grids.count = 0;
}

}  // namespace

void find_grids(const State& state, Plan& plan) {
    plan.grid_of.assign(state.bodies.size(), 0);
    plan.each_part([&](Plan::Island& island) {
        if (island.ties.count > 0) return fill_tied_grids(state, island, plan);
        const std::uint32_t body = Plan::part(plan.bodies, island.bodies).front();
        if (!island.isolated && island.bodies.count == 1) fill_grid(state, island, body, plan);
        island.grid = plan.grid_of[body];
    });
}

}  // namespace tendril::rope::detail
