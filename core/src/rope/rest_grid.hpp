// The unstrained shape of a body: its particles laid out in a plane. Not installed.
#pragma once

#include <vector>

#include "rope/geometry.hpp"
#include "tendril/rope/state.hpp"

namespace tendril::rope::detail {

/// Rows run in the direction of `along`; ropes and hair have no extent across them.
struct RestGrid {
    std::vector<double> along, down;  ///< metres from the first column, and from the first row
    double cosine = 0.0;              ///< cosine of the angle between rows and columns

    double length() const noexcept { return along.back(); }
    double width() const noexcept { return down.back(); }
    dvec3 at(std::size_t column, std::size_t row) const noexcept {
        return {along[column] + cosine * down[row], std::sqrt(1.0 - cosine * cosine) * down[row], 0.0};
    }
};

/// Where a link starts, and how far it leads, in columns and rows.
struct LinkStep {
    std::size_t column = 0, row = 0;  ///< start
    std::ptrdiff_t columns = 0, rows = 0;
};
LinkStep link_step(const Body& body, const Link& link) noexcept;

/// Torn links of a cloth take their lengths from those that are left.
RestGrid rest_grid(const State& state, const Body& body);

/// Compliance, in metres, of a stretch link whose material strains by 1 per newton: in a rope, a strand, or a
/// strip of cloth a metre wide.
double unit_link_compliance(const Body& body, const RestGrid& grid, const Link& link) noexcept;

/// Each point's share of a body's mass, as a length in metres: half the distance to each neighbour; at an
/// end, `end` times the distance to its only one.
std::vector<double> lumped_lengths(const std::vector<double>& at, double end);

}  // namespace tendril::rope::detail
