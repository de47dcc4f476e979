// After the last pass: moves particles out of colliders, whatever that does to lengths.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "rope/build.hpp"
#include "rope/geometry.hpp"
#include "rope/substep.hpp"
#include "tendril/chain/segment.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// Depth at which a particle may stay inside, metres: negligible.
constexpr double depth_tolerance = 1e-6;
constexpr int rounds = 12;
/// Distances that searches for a way out may compute in a substep; a particle still inside then stays there,
/// and is counted. Each island has a budget per particle, and its share, by particles, of a common one. A
/// particle between two surfaces takes about a hundred; in 10^5 random scenes no substep took over 1300.
constexpr std::uint64_t searches_per_particle = 128, shared_searches = 8192;
constexpr int newton_steps = 16;

/// The colliders that one particle can reach. The list of its chunk is complete within the chunk's box. A way
/// out of a large collider may lead beyond the box; there every collider of the world is tested.
struct Neighbours {
    const Scratch& scratch;
    std::span<const IslandScratch::Near> near;
    dvec3 low, high;                 ///< the chunk's box
    std::uint64_t& searches;         ///< distances that searches may still compute
    std::uint64_t& distances_taken;  ///< counts all distances

    /// Calls `visit` with the colliders that a ball may touch.
    template <class Visit>
    void each(const dvec3& at, double radius, Visit visit) const {
        const auto visit_if_near = [&](const Scratch::Moving& collider) {
            if (!collider.far_from(at, radius)) visit(*collider.shape);
        };
        if (in_box(at, radius)) {
            distances_taken += near.size();
            for (const IslandScratch::Near& each : near) visit_if_near(scratch.colliders[each.collider]);
        } else {
            distances_taken += scratch.colliders.size();
            for (const Scratch::Moving& each : scratch.colliders) visit_if_near(each);
        }
    }
    bool in_box(const dvec3& at, double radius) const {
        return at.x - radius >= low.x && at.y - radius >= low.y && at.z - radius >= low.z &&
               at.x + radius <= high.x && at.y + radius <= high.y && at.z + radius <= high.z;
    }
    /// The collider that contains a ball most deeply, and how deep; null and 0 if it is free.
    struct Deepest {
        const Shape* shape = nullptr;
        double depth = 0.0;
    };
    Deepest deepest(const dvec3& at, double radius) const {
        Deepest found;
        each(at, radius, [&](const Shape& shape) {
            const double depth = radius - surface_distance(shape, at).distance;
            if (depth > found.depth) found = {&shape, depth};
        });
        return found;
    }
    double depth(const dvec3& at, double radius) const { return deepest(at, radius).depth; }
};

/// The smallest displacement that brings a ball out of the two half spaces that it is deepest in, or out of
/// one if that suffices.
dvec3 smallest_displacement(const Neighbours& neighbours, const dvec3& at, double radius) {
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

/// The distance that a ball must move along a line to leave a shape; `limit` if that is farther. The distance
/// to a convex shape is convex along a line, so Newton's method approaches from the limit without
/// overshooting.
double exit_distance_of(const Shape& shape, const dvec3& from, const dvec3& along, double radius,
                        double limit, std::uint64_t& distances_taken) {
    double distance = limit;
    for (int i = 0; i < newton_steps; ++i) {
        ++distances_taken;
        const SurfaceDistance surface = surface_distance(shape, from + distance * along);
        const double over = surface.distance - radius, slope = detail::dot(surface.normal, along);
        if (over <= depth_tolerance || slope <= 0.0) break;
        distance -= (over - 0.5 * depth_tolerance) / slope;
    }
    return distance;
}

/// The distance along a line that leads out of every collider; `limit` if that is farther, or the search has
/// taken too long. A line never re-enters a convex shape, so each collider is left only once.
double exit_distance(const Neighbours& neighbours, const dvec3& from, const dvec3& along, double thickness,
                     double limit) {
    double distance = 0.0;
    for (std::size_t i = 0;
         i <= neighbours.scratch.colliders.size() && distance < limit && neighbours.searches > 0; ++i) {
        const std::uint64_t before = neighbours.distances_taken;
        const Shape* const inside = neighbours.deepest(from + distance * along, thickness).shape;
        if (inside == nullptr) return distance;
        distance = exit_distance_of(*inside, from, along, thickness, limit, neighbours.distances_taken);
        neighbours.searches -= std::min(neighbours.searches, neighbours.distances_taken - before);
    }
    return limit;
}

/// The shortest way out in 26 directions, for surfaces that nearly meet; false if none is found.
bool search_directions(const Neighbours& neighbours, const dvec3& from, double thickness, dvec3& at) {
    double shortest = max_magnitude;
    bool found = false;
    for (int k = 0; k < 27; ++k) {
        if (k == 13) continue;
        const dvec3 along = detail::unit(dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
        const double distance = exit_distance(neighbours, from, along, thickness, shortest);
        if (distance >= shortest) continue;
        shortest = distance, at = from + distance * along;
        found = true;
    }
    return found;
}

/// Moves a ball out of every collider, or at least its centre if the ball does not fit, and not far if a
/// short way is easy to find. If it finds no way out, returns false and leaves the ball where it is.
bool move_out(const Neighbours& neighbours, dvec3& x, double radius) {
    for (const double thickness : {radius, 0.0}) {
        dvec3 at = x;
        bool out = neighbours.depth(at, thickness) <= depth_tolerance;
        for (int i = 0; i < rounds && !out; ++i) {
            at += smallest_displacement(neighbours, at, thickness);
            out = neighbours.depth(at, thickness) <= depth_tolerance;
        }
        if (!out && !search_directions(neighbours, x, thickness, at)) continue;
        x = at;
        return true;
    }
    return false;
}

}  // namespace

/// Calls `visit` with each particle in [begin, end) that is near a collider, its body, and its neighbours.
template <class Visit>
void Substep::each_near(std::size_t begin, std::size_t end, Visit visit) {
    std::uint64_t searches = searches_per_particle * island_.particles +
                             shared_searches * island_.particles / state_.position.size();
    const auto is_before = [&](const IslandScratch::Near& each) {
        return plan_.chunks[each.chunk].first + plan_.chunks[each.chunk].count <= begin;
    };
    const std::span<const IslandScratch::Near> near(
        std::partition_point(local_.near.begin(), local_.near.end(), is_before), local_.near.end());
    for (std::size_t first = 0, last = 0; first < near.size(); first = last) {
        const Plan::Chunk& chunk = plan_.chunks[near[first].chunk];
        if (chunk.first >= end) break;
        while (last < near.size() && near[last].chunk == near[first].chunk) ++last;
        const Neighbours neighbours{scratch_,
                                    near.subspan(first, last - first),
                                    scratch_.chunk_low[near[first].chunk],
                                    scratch_.chunk_high[near[first].chunk],
                                    searches,
                                    report_.work};
        for (std::uint32_t i = chunk.first; i < chunk.first + chunk.count; ++i)
            if (begin <= i && i < end && scratch_.weight[i] > 0.0) visit(i, chunk.body, neighbours);
    }
}

void Substep::depenetrate() {
    if (state_.colliders.empty()) return;
    find_near();
    each_near(0, state_.position.size(),
              [&](std::uint32_t i, std::uint32_t body, const Neighbours& neighbours) {
                  const Body& of = state_.bodies[body];
                  const bool keeps = of.kind == Body::Kind::Cloth || detail::bends(state_, of);
                  dvec3& x = scratch_.x[i];
                  const dvec3 was = x;
                  const auto [shape, depth] = neighbours.deepest(x, of.radius);
                  if (depth <= (keeps ? penetration_slop : depth_tolerance)) return;
                  if (!move_out(neighbours, x, of.radius)) ++report_.unresolved;
                  record_impact(body, detail::length(x - was));
                  if (x == was || !local_.records_pushes) return;
                  const auto by = std::ranges::find(scratch_.colliders, shape, &Scratch::Moving::shape);
                  const auto number = static_cast<std::uint32_t>(by - scratch_.colliders.begin());
                  touch(i, number, detail::unit(x - was)).record(number, x - was);
              });
}

/// The depth of a chain's deepest particle in a collider; 0 if none is inside.
double Substep::depth_of(const Plan::Chain& chain, const std::vector<dvec3>& at) {
    double deepest = 0.0;
    const std::uint32_t first = plan_.nodes[chain.first_node];
    each_near(first, first + chain.links + 1,
              [&](std::uint32_t i, std::uint32_t body, const Neighbours& neighbours) {
                  deepest = std::max(deepest, neighbours.depth(at[i], state_.bodies[body].radius));
              });
    return deepest;
}

}  // namespace tendril::rope
