// After the last pass: brings what is still inside a collider out, as far as that does not tear it.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "rope/build.hpp"
#include "rope/geometry.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// How deep inside a particle may stay, metres: far less than anyone relies on.
constexpr double depth_tolerance = 1e-6;
constexpr int rounds = 12;
/// Of a way out, relative to the depth. Out of a right-angled corner it is 1.7.
constexpr double farthest_way = 2.0;

/// The colliders that one particle can reach. The list of its chunk is complete within the chunk's box. A way
/// out of a large collider may lead beyond the box; there every collider of the world is tested.
struct Neighbours {
    const Scratch& scratch;
    std::span<const IslandScratch::Near> near;
    dvec3 low, high;                 ///< the chunk's box
    double longest_link;             ///< that begins in the chunk
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
    /// How deep a ball is in the collider that contains it most deeply; 0 if it is free.
    double depth(const dvec3& at, double radius) const {
        double deepest = 0.0;
        each(at, radius, [&](const Shape& shape) {
            deepest = std::max(deepest, radius - surface_distance(shape, at).distance);
        });
        return deepest;
    }
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

/// Brings a ball out of every collider. False if that would tear its body, and is only begun: surfaces that
/// close on it leave no way, or a long one, and cloth comes out with its neighbours only.
bool bring_out(const Neighbours& neighbours, dvec3& place, double radius, bool cloth) {
    const double depth = neighbours.depth(place, radius), most = yield_strain * neighbours.longest_link;
    dvec3 at = place;
    bool out = false;
    for (int i = 0; i < rounds && !out; ++i) {
        at += smallest_displacement(neighbours, at, radius);
        out = neighbours.depth(at, radius) <= depth_tolerance;
    }
    const double far = detail::length(at - place);
    out = out && far <= std::max(most, cloth ? 0.0 : farthest_way * depth);
    place = out || far <= most ? at : place + (most / far) * (at - place);
    return out;
}

}  // namespace

/// Calls `visit` with each particle from `begin` to before `end` that is near a collider, its body, and its
/// neighbours.
template <class Visit>
void Substep::each_near(std::size_t begin, std::size_t end, Visit visit) {
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
                                    chunk.reach,
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
                  const double harmless = detail::bends(state_, of) ? harmless_depth : depth_tolerance;
                  dvec3& place = scratch_.place[i];
                  const dvec3 was = place;
                  if (neighbours.depth(place, of.radius) <= harmless) return;
                  const bool cloth = of.kind == Body::Kind::Cloth && neighbours.near.size() > 1;
                  if (!bring_out(neighbours, place, of.radius, cloth)) ++report_.unresolved;
                  strike(body, detail::length(place - was));
              });
}

/// How deep the deepest particle of a chain would be in a collider; 0 if none is.
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
