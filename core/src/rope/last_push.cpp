// After the last pass: what is still inside a collider comes out, whatever that does to lengths.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "rope/geometry.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// How far inside a particle may stay, metres: far less than what anybody may rely on.
constexpr double tolerance = 1e-6;
constexpr int rounds = 12;

/// The colliders that one particle can reach.
struct Neighbours {
    const World::Scratch& scratch;
    std::span<const World::Scratch::Near> near;

    /// Those that a ball may touch.
    template <class Visit>
    void each(const dvec3& at, double radius, Visit visit) const {
        for (const World::Scratch::Near& each : near) {
            const World::Scratch::Moving& collider = scratch.colliders[each.collider];
            if (!collider.far_from(at, radius)) visit(*collider.shape);
        }
    }
    /// How deep a ball is in the collider that it is deepest in; 0 where it is free.
    double depth(const dvec3& at, double radius) const {
        double deepest = 0.0;
        each(at, radius, [&](const Shape& shape) {
            deepest = std::max(deepest, radius - surface_distance(shape, at).distance);
        });
        return deepest;
    }
};

/// The least move that brings a ball out of the two half spaces that it is deepest in; of one, where that
/// does.
dvec3 least_move(const Neighbours& neighbours, const dvec3& at, double radius) {
    std::array<dvec3, 2> normal{};
    std::array<double, 2> depth{0.0, 0.0};
    neighbours.each(at, radius, [&](const Shape& shape) {
        const SurfaceDistance surface = surface_distance(shape, at);
        const double deep = radius - surface.distance;
        if (deep > depth[0]) {
            depth[1] = depth[0], normal[1] = normal[0];
            depth[0] = deep, normal[0] = surface.normal;
        } else if (deep > depth[1]) {
            depth[1] = deep, normal[1] = surface.normal;
        }
    });
    const double along = detail::dot(normal[0], normal[1]), apart = 1.0 - along * along;
    const double rest = depth[1] - along * depth[0];
    if (depth[1] <= 0.0 || rest <= 0.0 || apart < 1e-9) return depth[0] * normal[0];
    const double second = rest / apart, first = depth[0] - along * second;
    return first > 0.0 ? first * normal[0] + second * normal[1] : depth[1] * normal[1];
}

/// Out along a line, as far as every collider on the way asks for; no number where there is no end.
double way_out(const Neighbours& neighbours, const dvec3& from, const dvec3& along, double thickness) {
    double way = 0.0;
    for (int i = 0; i < 200; ++i) {
        const double depth = neighbours.depth(from + way * along, thickness + tolerance);
        if (depth <= 0.0) return way;
        way += depth + tolerance;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// Where a ball is out of every collider; where there is no room for all of it, at least its middle is. Near
/// `from`, if that is easily found.
dvec3 outside(const Neighbours& neighbours, const dvec3& from, double radius) {
    for (const double thickness : {radius, 0.0}) {
        dvec3 at = from;
        for (int i = 0; i < rounds; ++i) {
            if (neighbours.depth(at, thickness) <= tolerance) return at;
            at += least_move(neighbours, at, thickness);
        }
        if (neighbours.depth(at, thickness) <= tolerance) return at;
        // Between surfaces that all but meet: the shortest way out of 26.
        double shortest = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 27; ++k) {
            if (k == 13) continue;
            const dvec3 along = detail::unit(dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
            const double way = way_out(neighbours, from, along, thickness);
            if (way < shortest) shortest = way, at = from + way * along;
        }
        if (shortest < std::numeric_limits<double>::infinity()) return at;
    }
    return from;
}

}  // namespace

void Substep::push_out_for_good() {
    if (state_.colliders.empty()) return;
    find_near();
    const std::span<const World::Scratch::Near> near(scratch_.near);
    for (std::size_t first = 0, end = 0; first < near.size(); first = end) {
        while (end < near.size() && near[end].chunk == near[first].chunk) ++end;
        const World::Plan::Chunk& chunk = plan_.chunks[near[first].chunk];
        const Neighbours neighbours{scratch_, near.subspan(first, end - first)};
        const double radius = state_.bodies[chunk.body].radius;
        for (std::uint32_t i = chunk.first; i < chunk.first + chunk.count; ++i) {
            dvec3& place = scratch_.place[i];
            if (scratch_.weight[i] == 0.0 || neighbours.depth(place, radius) <= tolerance) continue;
            place = outside(neighbours, place, radius);
        }
    }
}

}  // namespace tendril::rope
