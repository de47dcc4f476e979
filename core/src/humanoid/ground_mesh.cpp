// Triangles sorted into a horizontal grid of squares.
#include <algorithm>
#include <cmath>
#include <limits>

#include "math/checks.hpp"
#include "rig/math.hpp"
#include "tendril/humanoid/ground.hpp"

namespace tendril::humanoid {
namespace {

using tendril::detail::Argument;
using tendril::detail::refused;

constexpr std::size_t max_triangles = 20'000'000, max_side = 4096;
constexpr double max_coordinate = 1e6;  ///< metres

/// Twice the area of a, b, p seen from above, positive if p is to the left of a to b.
double side(const glm::dvec3& a, const glm::dvec3& b, double x, double z) noexcept {
    return (b.x - a.x) * (z - a.z) - (b.z - a.z) * (x - a.x);
}

}  // namespace

Expected<Ground> Ground::mesh(std::span<const glm::dvec3> vertices,
                              std::span<const std::uint32_t> triangles) {
    constexpr const char* operation = "mesh";
    if (triangles.empty() || triangles.size() % 3 != 0 || triangles.size() / 3 > max_triangles)
        return refused(operation, "triangles", "three indices each for 1 to 2e7 triangles", triangles.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (const double number : {vertices[i].x, vertices[i].y, vertices[i].z})
            if (!(std::abs(number) <= max_coordinate))
                return refused(operation, Argument("vertices", i), "from -1e6 to 1e6 m", number);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if (triangles[i] >= vertices.size())
            return refused(operation, Argument("triangles", i), "the index of a vertex",
                           static_cast<std::size_t>(triangles[i]));
    Mesh made{};
    made.triangles.reserve(triangles.size() / 3);
    for (std::size_t i = 0; i < triangles.size(); i += 3)
        made.triangles.push_back(
            {vertices[triangles[i]], vertices[triangles[i + 1]], vertices[triangles[i + 2]]});
    made.sort();
    return Ground(Shape(std::move(made)));
}

std::size_t Ground::Mesh::square(double at, double origin, std::size_t count) const noexcept {
    const double place = (at - origin) / cell;
    return place > 0.0 ? std::min(static_cast<std::size_t>(place), count - 1) : 0;
}

template <class Visit>
void Ground::Mesh::for_squares(const Triangle& t, Visit visit) const {
    const std::size_t left = square(std::min({t.a.x, t.b.x, t.c.x}), x, columns),
                      right = square(std::max({t.a.x, t.b.x, t.c.x}), x, columns),
                      near = square(std::min({t.a.z, t.b.z, t.c.z}), z, rows),
                      away = square(std::max({t.a.z, t.b.z, t.c.z}), z, rows);
    for (std::size_t row = near; row <= away; ++row)
        for (std::size_t column = left; column <= right; ++column) visit(row * columns + column);
}

void Ground::Mesh::sort() {
    constexpr double most = std::numeric_limits<double>::max();
    double x_end = -most, z_end = -most;
    x = z = most;
    for (const Triangle& t : triangles) {
        x = std::min({x, t.a.x, t.b.x, t.c.x});
        z = std::min({z, t.a.z, t.b.z, t.c.z});
        x_end = std::max({x_end, t.a.x, t.b.x, t.c.x});
        z_end = std::max({z_end, t.a.z, t.b.z, t.c.z});
    }
    const double wide = std::max(x_end - x, 1e-3), deep = std::max(z_end - z, 1e-3);
    cell = std::max(std::sqrt(wide * deep / static_cast<double>(triangles.size())),
                    std::max(wide, deep) / static_cast<double>(max_side));
    // Large triangles cover many squares: use fewer, so that the lists stay proportional to the mesh.
    const std::size_t max_entries = 12 * triangles.size() + 64;
    for (;; cell *= 2.0) {
        columns = static_cast<std::size_t>(wide / cell) + 1;
        rows = static_cast<std::size_t>(deep / cell) + 1;
        std::size_t entries = 0;
        for (const Triangle& t : triangles) {
            const auto count = [&](double a, double b, double c, double origin, std::size_t squares) {
                return square(std::max({a, b, c}), origin, squares) -
                       square(std::min({a, b, c}), origin, squares) + 1;
            };
            entries += count(t.a.x, t.b.x, t.c.x, x, columns) * count(t.a.z, t.b.z, t.c.z, z, rows);
        }
        if (entries <= max_entries || columns * rows == 1) break;
    }
    first.assign(columns * rows + 1, 0);
    for (const Triangle& t : triangles) for_squares(t, [&](std::size_t at) { ++first[at + 1]; });
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    sorted.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for_squares(triangles[i],
                    [&](std::size_t at) { sorted[next[at]++] = static_cast<std::uint32_t>(i); });
}

std::optional<GroundHit> Ground::Mesh::below(const glm::dvec3& from) const noexcept {
    const double u = (from.x - x) / cell, v = (from.z - z) / cell;
    if (!(u >= 0.0 && v >= 0.0 && u <= static_cast<double>(columns) && v <= static_cast<double>(rows)))
        return std::nullopt;
    const std::size_t at = square(from.z, z, rows) * columns + square(from.x, x, columns);
    const Triangle* best = nullptr;
    double height = 0.0;
    for (std::uint32_t i = first[at]; i < first[at + 1]; ++i) {
        const Triangle& t = triangles[sorted[i]];
        const double area = side(t.a, t.b, t.c.x, t.c.z);
        const double size = std::abs(area), sign = area < 0.0 ? -1.0 : 1.0;
        const double c = sign * side(t.a, t.b, from.x, from.z), a = sign * side(t.b, t.c, from.x, from.z),
                     b = sign * side(t.c, t.a, from.x, from.z);
        const double rounding = -1e-9 * size;  // a ray through an edge hits at least one of its triangles
        if (!(size > 1e-18) || a < rounding || b < rounding || c < rounding) continue;
        const double y = (a * t.a.y + b * t.b.y + c * t.c.y) / (a + b + c);
        if (y > from.y || (best && y <= height)) continue;
        best = &t;
        height = y;
    }
    if (!best) return std::nullopt;
    using namespace rig::detail;
    const glm::dvec3 normal = cross(minus(best->c, best->a), minus(best->b, best->a));
    const auto unit = direction_of(times(normal, normal.y < 0.0 ? -1.0 : 1.0), 1e-300);
    return GroundHit{height, unit.value_or(glm::dvec3(0.0, 1.0, 0.0))};
}

}  // namespace tendril::humanoid
