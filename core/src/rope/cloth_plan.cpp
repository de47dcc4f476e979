#include "rope/cloth_plan.hpp"

#include <algorithm>

#include "rope/grid_system.hpp"

namespace tendril::rope::detail {
namespace {

/// Finds the cell and the step of a link in a grid; false if it is not a grid link.
bool place_in_grid(const Body& body, const Link& link, std::size_t stride, Plan::GridLink& in_grid) {
    const auto low = std::min(link.a, link.b), high = std::max(link.a, link.b);
    const std::size_t first = low - body.first, last = high - body.first;
    const auto columns = static_cast<int>(last % body.row) - static_cast<int>(first % body.row);
    const auto rows = last / body.row - first / body.row;
    for (std::size_t s = 0; s < grid_steps.size(); ++s) {
        if (grid_steps[s].column != columns || static_cast<std::size_t>(grid_steps[s].row) != rows) continue;
        in_grid.cell = static_cast<std::uint32_t>(first / body.row * stride + first % body.row);
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
    if (body.count % body.row != 0 || body.count < 2 * body.row) return false;
    Plan::Grid grid{.body = number,
                    .columns = static_cast<std::uint32_t>(body.row),
                    .rows = static_cast<std::uint32_t>(body.count / body.row),
                    .links = {static_cast<std::uint32_t>(plan.grid_links.size()), island.links.count}};
    std::vector<std::uint8_t> taken(grid_stride(body.row) * grid.rows, 0);  // a bit per step
    for (const std::uint32_t i : Plan::part(plan.links, island.links)) {
        Plan::GridLink link{.link = i};
        const bool fits = place_in_grid(body, state.links[i], grid_stride(body.row), link);
        const auto bit = static_cast<std::uint8_t>(1u << link.step);
        if (!fits || (taken[link.cell] & bit) != 0) {
            plan.grid_links.resize(grid.links.first);
            return false;
        }
        taken[link.cell] = static_cast<std::uint8_t>(taken[link.cell] | bit);
        plan.grid_links.push_back(link);
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
