#include "rope/cloth_plan.hpp"

#include <algorithm>

#include "rope/grid_system.hpp"
#include "rope/rest_grid.hpp"

namespace tendril::rope::detail {
namespace {

/// Finds the cell and the step of a link in a grid; false if it is not a grid link.
bool place_in_grid(const Body& body, const Link& link, std::size_t stride, Plan::GridLink& in_grid) {
    const LinkWay way = way_of(body, link);
    for (std::size_t s = 0; s < grid_steps.size(); ++s) {
        if (grid_steps[s].column != way.columns || grid_steps[s].row != way.rows) continue;
        in_grid.cell = static_cast<std::uint32_t>(way.row * stride + way.column);
        in_grid.step = static_cast<std::uint32_t>(s);
        return true;
    }
    return false;
}

/// Adds a grid that contains every link of an island exactly once; false if there is none.
bool fill_grid(const State& state, const Plan::Island& island, Plan& plan) {
    const std::uint32_t number = Plan::part(plan.bodies, island.bodies).front();
    const Body& body = state.bodies[number];
    if (island.bodies.count != 1 || body.kind != Body::Kind::Cloth || body.row < 2) return false;
    if (body.rows() < 2 || body.row * body.rows() > 16 * body.count + 64) return false;  // mostly gaps
    Plan::Grid grid{.body = number,
                    .columns = static_cast<std::uint32_t>(body.row),
                    .rows = static_cast<std::uint32_t>(body.rows()),
                    .links = {static_cast<std::uint32_t>(plan.grid_links.size()), island.links.count},
                    .cells = {static_cast<std::uint32_t>(plan.grid_cells.size()),
                              static_cast<std::uint32_t>(body.count)}};
    const std::size_t stride = grid_stride(body.row);
    std::vector<std::uint8_t> taken(stride * grid.rows, 0);  // a bit per step
    for (const std::uint32_t i : Plan::part(plan.links, island.links)) {
        Plan::GridLink link{.link = i};
        const bool fits = place_in_grid(body, state.links[i], stride, link);
        const auto bit = static_cast<std::uint8_t>(1u << link.step);
        if (!fits || (taken[link.cell] & bit) != 0) {
            plan.grid_links.resize(grid.links.first);
            return false;
        }
        taken[link.cell] = static_cast<std::uint8_t>(taken[link.cell] | bit);
        plan.grid_links.push_back(link);
    }
    for (std::size_t i = 0; i < body.count; ++i) {
        const std::size_t cell = body.cell(i);
        plan.grid_cells.push_back(static_cast<std::uint32_t>(cell / body.row * stride + cell % body.row));
    }
    plan.grids.push_back(grid);
    return true;
}

}  // namespace

void find_grids(const State& state, Plan& plan) {
    plan.each_part([&](Plan::Island& island) {
        if (!island.alone && fill_grid(state, island, plan))
            island.grid = static_cast<std::uint32_t>(plan.grids.size());
    });
}

}  // namespace tendril::rope::detail
