#include "rope/rest_grid.hpp"

#include <algorithm>
#include <numeric>

#include "rope/slots.hpp"

namespace tendril::rope::detail {
namespace {

constexpr double none = -1.0;

/// Sums steps to coordinates. An unknown step is the mean of the known ones.
std::vector<double> cumulative(std::vector<double> steps) {
    double known = 0.0, count = 0.0;
    for (const double step : steps)
        if (step != none) known += step, ++count;
    std::replace(steps.begin(), steps.end(), none, count > 0.0 ? known / count : 0.0);
    steps.insert(steps.begin(), 0.0);
    std::partial_sum(steps.begin(), steps.end(), steps.begin());
    return steps;
}

}  // namespace

LinkStep link_step(const Body& body, const Link& link) noexcept {
    const std::size_t low = body.cell(std::min(link.a, link.b) - body.first),
                      high = body.cell(std::max(link.a, link.b) - body.first);
    LinkStep step{.column = low % body.row, .row = low / body.row};
    step.columns = static_cast<std::ptrdiff_t>(high % body.row) - static_cast<std::ptrdiff_t>(step.column);
    step.rows = static_cast<std::ptrdiff_t>(high / body.row) - static_cast<std::ptrdiff_t>(step.row);
    return step;
}

RestGrid rest_grid(const State& state, const Body& body) {
    std::vector<double> along(body.row - 1, none), down(body.rows() - 1, none);
    const Link* shear = nullptr;
    for (const Link& link : state.links) {
        if (!is_within(body, link)) continue;
        const LinkStep step = link_step(body, link);
        if (link.kind == Link::Kind::Shear && !shear && std::abs(step.columns) == 1 && step.rows == 1)
            shear = &link;
        if (link.kind != Link::Kind::Stretch) continue;
        if (step.columns == 1 && step.rows == 0 && along[step.column] == none) along[step.column] = link.rest;
        if (step.columns == 0 && step.rows == 1 && down[step.row] == none) down[step.row] = link.rest;
    }
    RestGrid grid{.along = cumulative(std::move(along)), .down = cumulative(std::move(down))};
    if (shear == nullptr) return grid;
    const LinkStep step = link_step(body, *shear);
    const std::size_t col = step.columns > 0 ? step.column : step.column - 1;
    const double a = grid.along[col + 1] - grid.along[col], b = grid.down[step.row + 1] - grid.down[step.row];
    const double rest = shear->rest, product = 2.0 * static_cast<double>(step.columns) * a * b;
    if (product != 0.0) grid.cosine = std::clamp((rest * rest - a * a - b * b) / product, -0.999, 0.999);
    if (std::abs(grid.cosine) < 1e-6) grid.cosine = 0.0;  // rounding
    return grid;
}

double unit_link_compliance(const Body& body, const RestGrid& grid, const Link& link) noexcept {
    if (body.kind != Body::Kind::Cloth) return link.rest;
    // A thread carries an equal share of the cloth beside it.
    const bool in_row = link_step(body, link).rows == 0;
    const double spacing = in_row ? grid.width() / static_cast<double>(grid.down.size())
                                  : grid.length() / static_cast<double>(grid.along.size());
    return spacing > 0.0 ? link.rest / spacing : 1.0;
}

std::vector<double> lumped_lengths(const std::vector<double>& at, double end) {
    std::vector<double> list(at.size(), 1.0);
    if (at.size() < 2 || !(at.back() > 0.0)) return list;
    const std::size_t last = at.size() - 1;
    for (std::size_t i = 1; i < last; ++i) list[i] = 0.5 * (at[i + 1] - at[i - 1]);
    list[0] = end * at[1];
    list[last] = end * (at[last] - at[last - 1]);
    return list;
}

}  // namespace tendril::rope::detail
