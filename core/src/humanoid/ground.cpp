#include "tendril/humanoid/ground.hpp"

#include <cmath>
#include <limits>

#include "rig/checks.hpp"
#include "rig/math.hpp"
#include "tendril/elementary.hpp"

namespace tendril::humanoid {
namespace {

using tendril::detail::Argument;
using tendril::detail::refused;

constexpr double max_extent = 1e6;

bool is_point(const glm::dvec3& p) noexcept {
    return std::abs(p.x) <= 1e9 && std::abs(p.y) <= std::numeric_limits<double>::max() &&
           std::abs(p.z) <= 1e9;
}

}  // namespace

const char* name(GroundKind kind) noexcept {
    constexpr const char* names[] = {"none", "flat", "slope", "stairs", "terrain", "mesh"};
    return names[static_cast<std::size_t>(kind)];
}

Expected<Ground> Ground::flat(double height) {
    if (!(std::abs(height) <= max_extent)) return refused("flat", "height", "from -1e6 to 1e6 m", height);
    return Ground(Shape(Flat{height}));
}

Expected<Ground> Ground::slope(double angle) {
    if (!(std::abs(angle) <= 1.5)) return refused("slope", "angle", "from -1.5 to 1.5 radians", angle);
    const auto [sine, cosine] = math::sine_cosine(angle);
    return Ground(Shape(Slope{sine / cosine}));
}

Expected<Ground> Ground::stairs(double step_height, double step_depth) {
    if (!(std::abs(step_height) <= 100.0))
        return refused("stairs", "step_height", "from -100 to 100 m", step_height);
    if (!(step_depth >= 0.01 && step_depth <= 1e3))
        return refused("stairs", "step_depth", "from 0.01 to 1e3 m", step_depth);
    return Ground(Shape(Stairs{step_height, step_depth}));
}

Expected<Ground> Ground::terrain(HeightField field) {
    constexpr const char* operation = "terrain";
    if (const Result bad = rig::detail::check_number(operation, "x", field.x); !bad) return bad;
    if (const Result bad = rig::detail::check_number(operation, "z", field.z); !bad) return bad;
    if (!(field.cell >= 0.001 && field.cell <= max_extent))
        return refused(operation, "cell", "from 0.001 to 1e6 m", field.cell);
    const std::size_t count = field.heights.size();
    if (field.columns < 2 || field.columns > count)
        return refused(operation, "columns", "at least 2, and at most the number of heights", field.columns);
    if (count > 100'000'000 || count % field.columns != 0 || count / field.columns < 2)
        return refused(operation, "heights", "at least 2 complete rows and at most 1e8 heights", count);
    for (std::size_t i = 0; i < count; ++i)
        if (!(std::abs(field.heights[i]) <= max_extent))
            return refused(operation, Argument("heights", i), "from -1e6 to 1e6 m", field.heights[i]);
    const std::size_t rows = count / field.columns;
    return Ground(Shape(Terrain{std::move(field), rows}));
}

GroundHit Ground::Slope::on(double z) const noexcept {
    if (!(z > 0.0)) return {};
    const double scale = 1.0 / std::sqrt(1.0 + rise * rise);
    return {z * rise, {0.0, scale, -rise * scale}};
}

std::optional<GroundHit> Ground::Terrain::at(double px, double pz) const noexcept {
    const double u = (px - field.x) / field.cell, v = (pz - field.z) / field.cell;
    const auto last_column = field.columns - 1, last_row = rows - 1;
    if (!(u >= 0.0 && v >= 0.0 && u <= static_cast<double>(last_column) &&
          v <= static_cast<double>(last_row)))
        return std::nullopt;
    const std::size_t column = std::min(static_cast<std::size_t>(u), last_column - 1);
    const std::size_t row = std::min(static_cast<std::size_t>(v), last_row - 1);
    const double s = u - static_cast<double>(column), t = v - static_cast<double>(row);
    const double* corner = &field.heights[row * field.columns + column];
    const double* next = corner + field.columns;
    const double near = corner[0] + (corner[1] - corner[0]) * s, away = next[0] + (next[1] - next[0]) * s;
    const double along_x = ((corner[1] - corner[0]) * (1.0 - t) + (next[1] - next[0]) * t) / field.cell;
    const double along_z = (away - near) / field.cell;
    const double scale = 1.0 / std::sqrt(1.0 + along_x * along_x + along_z * along_z);
    return GroundHit{near + (away - near) * t, {-along_x * scale, scale, -along_z * scale}};
}

std::optional<GroundHit> Ground::below(const glm::dvec3& from) const noexcept {
    if (!is_point(from)) return std::nullopt;
    switch (kind()) {
        case GroundKind::None:
            return std::nullopt;
        case GroundKind::Flat:
            return GroundHit{std::get_if<Flat>(&shape_)->height, {0.0, 1.0, 0.0}};
        case GroundKind::Slope:
            return std::get_if<Slope>(&shape_)->on(from.z);
        case GroundKind::Stairs: {
            const Stairs& stairs = *std::get_if<Stairs>(&shape_);
            return GroundHit{stairs.height * std::floor(std::max(0.0, from.z) / stairs.depth),
                             {0.0, 1.0, 0.0}};
        }
        case GroundKind::Terrain:
            return std::get_if<Terrain>(&shape_)->at(from.x, from.z);
        case GroundKind::Mesh:
            return std::get_if<Mesh>(&shape_)->below(from);
    }
    return std::nullopt;
}

std::optional<GroundHit> Ground::highest(double x, double z) const noexcept {
    return below({x, 2.0 * max_extent, z});
}

}  // namespace tendril::humanoid
