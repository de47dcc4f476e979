// After the last pass: what is still inside a collider comes out, whatever that does to lengths.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "rope/geometry.hpp"
#include "rope/substep.hpp"
#include "tendril/chain/segment.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// How far inside a particle may stay, metres: far less than what anybody may rely on.
constexpr double tolerance = 1e-6;
constexpr int rounds = 12;
/// Distances that the search for a way out may look at in a substep: what it does not find by then is left
/// inside and counted. A particle between two surfaces takes some hundred.
constexpr std::size_t searches_per_particle = 64, fewest_searches = 8192;

/// The colliders that one particle can reach.
struct Neighbours {
    const Scratch& scratch;
    std::span<const Scratch::Near> near;
    std::size_t& searches;  ///< that are left
    std::uint64_t& looked;  ///< counts the distances that were looked at

    /// Those that a ball may touch.
    template <class Visit>
    void each(const dvec3& at, double radius, Visit visit) const {
        looked += near.size();
        for (const Scratch::Near& each : near) {
            const Scratch::Moving& collider = scratch.colliders[each.collider];
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

/// Out along a line, as far as every collider on the way asks for; no number where that is `limit` or more,
/// or the search takes too long.
double way_out(const Neighbours& neighbours, const dvec3& from, const dvec3& along, double thickness,
               double limit) {
    double way = 0.0;
    for (int i = 0; i < 200 && way < limit && neighbours.searches >= neighbours.near.size(); ++i) {
        neighbours.searches -= neighbours.near.size();
        const double depth = neighbours.depth(from + way * along, thickness + tolerance);
        if (depth <= 0.0) return way;
        way += depth + tolerance;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// The shortest way out of 26, between surfaces that all but meet; false where none is found.
bool search(const Neighbours& neighbours, const dvec3& from, double thickness, dvec3& at) {
    double shortest = max_magnitude;
    bool found = false;
    for (int k = 0; k < 27; ++k) {
        if (k == 13) continue;
        const dvec3 along = detail::unit(dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
        const double way = way_out(neighbours, from, along, thickness, shortest);
        if (!(way < shortest)) continue;
        shortest = way, at = from + way * along;
        found = true;
    }
    return found;
}

/// Brings a ball out of every collider; where there is no room for all of it, at least its middle. Near where
/// it is, if that is easily found; false, and unmoved, where it is not found at all.
bool bring_out(const Neighbours& neighbours, dvec3& place, double radius) {
    for (const double thickness : {radius, 0.0}) {
        dvec3 at = place;
        bool out = neighbours.depth(at, thickness) <= tolerance;
        for (int i = 0; i < rounds && !out; ++i) {
            at += least_move(neighbours, at, thickness);
            out = neighbours.depth(at, thickness) <= tolerance;
        }
        if (!out && !search(neighbours, place, thickness, at)) continue;
        place = at;
        return true;
    }
    return false;
}

}  // namespace

void Substep::depenetrate() {
    if (state_.colliders.empty()) return;
    find_near();
    const std::span<const Scratch::Near> near(scratch_.near);
    std::size_t searches = std::max(fewest_searches, searches_per_particle * state_.position.size());
    for (std::size_t first = 0, end = 0; first < near.size(); first = end) {
        while (end < near.size() && near[end].chunk == near[first].chunk) ++end;
        const Plan::Chunk& chunk = plan_.chunks[near[first].chunk];
        const Neighbours neighbours{scratch_, near.subspan(first, end - first), searches, report_.work};
        const double radius = state_.bodies[chunk.body].radius;
        for (std::uint32_t i = chunk.first; i < chunk.first + chunk.count; ++i) {
            dvec3& place = scratch_.place[i];
            if (scratch_.weight[i] == 0.0 || neighbours.depth(place, radius) <= tolerance) continue;
            if (!bring_out(neighbours, place, radius)) ++report_.unresolved;
        }
    }
}

}  // namespace tendril::rope
