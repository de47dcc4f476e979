// Keeps particles and links out of colliders during the solve: for cloth and hair, and for all bodies with a
// solver that takes one link after the other. Ropes solved directly have their own contacts
// (chain_contact.cpp).
//
// Contacts remember how far a collider has displaced a particle in the substep: the part along the normal
// bounds friction (Coulomb's law, as displacements). That part includes the depth to which tension pulls a
// particle into the collider, so a taut rope round a post has more friction than a slack one.
#include <algorithm>
#include <limits>
#include <optional>

#include "math/rotation.hpp"
#include "rope/build.hpp"
#include "rope/contact_shape.hpp"
#include "rope/geometry.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// Maximum steps along a path: they find a bar of 6 mm at up to 200 m/s with substeps of 1/240 s.
constexpr double max_sweep_steps = 64.0;

struct Bounds {
    dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void add(const dvec3& point) {
        low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
        high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
    }
    void expand(double by) { low -= dvec3(by), high += dvec3(by); }
    bool overlaps(const dvec3& other_low, const dvec3& other_high) const {
        return low.x <= other_high.x && low.y <= other_high.y && low.z <= other_high.z &&
               high.x >= other_low.x && high.y >= other_low.y && high.z >= other_low.z;
    }
};

}  // namespace

dvec3 Scratch::Moving::move_at(const dvec3& at) const {
    if (spins) {
        const dvec3 from = at - middle, all = by + (from - math::rotated(inverse_spin, from));
        const auto* const plane = std::get_if<Plane>(shape);
        if (plane == nullptr) return all;
        const dvec3 normal = detail::unit(dvec3(plane->normal));  // a plane does not move along itself
        return all - detail::dot(all, normal) * normal;
    }
    if (turn == dvec3(0.0)) return by;
    const auto& capsule = std::get<Capsule>(*shape);
    const dvec3 a(capsule.a), axis = dvec3(capsule.b) - a;
    const double squared = detail::dot(axis, axis);
    const double t = squared > 0.0 ? std::clamp(detail::dot(at - a, axis) / squared, 0.0, 1.0) : 0.5;
    return by + (2.0 * t - 1.0) * turn;
}

std::optional<Scratch::Moving::At> Scratch::Moving::nearest(const Segment& at, double reach,
                                                            std::uint64_t& work) const {
    const dvec3 along = at[1] - at[0];
    if (far_from(at[0] + 0.5 * along, reach + 0.5 * detail::length(along))) return std::nullopt;
    const std::optional<double> part = detail::nearest_between(*shape, at[0], at[1], reach, work);
    if (!part) return std::nullopt;
    const dvec3 point = at[0] + *part * along;
    ++work;
    return At{*part, point, surface_distance(*shape, point)};
}

/// Advances by the distance to the surface, as nothing can be hit before (B. Mirtich, "Impulse-based Dynamic
/// Simulation", 1996), but at least by a quarter of the half thickness.
std::optional<Scratch::Moving::At> Scratch::Moving::first_touch(const Segment& from, const Segment& to,
                                                                double radius, std::uint64_t& work) const {
    const bool particle = from[0] == from[1] && to[0] == to[1];
    const dvec3 a = to[0] - from[0], b = to[1] - from[1];
    const double way = std::sqrt(std::max(detail::dot(a, a), detail::dot(b, b))), thick = 0.5 * size + radius;
    if (!(way > thick)) return std::nullopt;
    const auto stops = [&](const At& at) {  // whether its tangent plane keeps out the end of the path
        const double depth = radius - at.surface.distance;
        const dvec3 end = to[0] + at.along * (to[1] - to[0]);
        return depth > 0.0 && detail::dot(at.surface.normal, end - at.point) < depth;
    };
    for (double done = 0.0; done <= way;) {
        const Segment at{from[0] + (done / way) * a, from[1] + (done / way) * b};
        At first{0.0, at[0], surface_distance(*shape, at[0])};
        ++work;
        double distance = first.surface.distance - radius;
        if (!particle) {
            distance = std::min(distance, surface_distance(*shape, at[1]).distance - radius);
            const std::optional<At> between = nearest(at, radius + way - done, work);
            if (between) distance = std::min(distance, between->surface.distance - radius);
            if (between && stops(*between)) return between;
        } else if (stops(first)) {
            return first;
        }
        done += std::max({distance, 0.25 * thick, way / max_sweep_steps});
    }
    return std::nullopt;
}

SurfaceDistance Scratch::Moving::sweep(const dvec3& was, dvec3& at, double radius,
                                       std::uint64_t& work) const {
    const dvec3 from = was + move_at(at);
    const std::optional<At> touch = first_touch({from, from}, {at, at}, radius, work);
    if (!touch) return surface_distance(*shape, at);
    at = touch->point;
    return touch->surface;
}

void Substep::find_near() {
    local_.near.clear();
    if (state_.colliders.empty()) return;
    Bounds whole;
    const std::uint32_t first_chunk = island_.chunks.first, end_chunk = first_chunk + island_.chunks.count;
    for (std::uint32_t c = first_chunk; c < end_chunk; ++c) {
        const Plan::Chunk& chunk = plan_.chunks[c];
        Bounds bounds;
        double farthest = 0.0;
        for (std::uint32_t i = chunk.first; i < chunk.first + chunk.count; ++i) {
            const dvec3 by = scratch_.x[i] - state_.position[i];
            farthest = std::max(farthest, detail::dot(by, by));
            bounds.add(scratch_.x[i]);
            bounds.add(state_.position[i]);
        }
        bounds.expand(std::sqrt(farthest) + state_.bodies[chunk.body].radius + chunk.reach + path_margin);
        scratch_.chunk_low[c] = bounds.low;
        scratch_.chunk_high[c] = bounds.high;
        whole.add(bounds.low);
        whole.add(bounds.high);
    }
    // A body far from all colliders needs no further checks.
    local_.close.clear();
    for (std::uint32_t k = 0; k < scratch_.colliders.size(); ++k) {
        if (whole.overlaps(scratch_.colliders[k].low, scratch_.colliders[k].high)) local_.close.push_back(k);
    }
    for (std::uint32_t c = first_chunk; c < end_chunk; ++c) {
        const Bounds chunk{scratch_.chunk_low[c], scratch_.chunk_high[c]};
        for (const std::uint32_t k : local_.close) {
            const Scratch::Moving& collider = scratch_.colliders[k];
            const bool overlaps = chunk.overlaps(collider.low, collider.high);
            if (!overlaps || detail::beyond(*collider.shape, chunk.low, chunk.high)) continue;
            local_.near.push_back({c, k});
            Scratch::Nearest& nearest = scratch_.body_near[plan_.chunks[c].body];
            nearest =
                std::max(nearest, collider.moves() ? Scratch::Nearest::Moving : Scratch::Nearest::Resting);
        }
    }
}

Touch& Substep::touch(std::uint32_t i, std::uint32_t collider, const dvec3& normal) {
    Touch& touch = scratch_.touch[i];
    if (!touch.touching) {
        touch.touching = true;
        touch.collider_displacement = scratch_.colliders[collider].move_at(scratch_.x[i]);
        touch.normal = normal;
        touch.collider = collider;
        local_.touched.push_back(i);
    }
    return touch;
}

void Substep::apply_friction(std::uint32_t i, std::uint32_t body) {
    Touch& touch = scratch_.touch[i];
    const double normal_part = detail::dot(touch.displacement, touch.normal);
    const dvec3 friction = touch.displacement - normal_part * touch.normal;
    const dvec3 slip = scratch_.x[i] - state_.position[i] - touch.collider_displacement;
    dvec3 wanted = friction - (slip - detail::dot(slip, touch.normal) * touch.normal);
    const double size = detail::length(wanted),
                 limit = detail::friction(state_, state_.bodies[body]) * normal_part;
    if (size > limit) wanted = (limit / size) * wanted;
    scratch_.x[i] += wanted - friction;
    touch.record(touch.collider, wanted - friction);
    touch.displacement = normal_part * touch.normal + wanted;
}

void Substep::resolve_contacts(bool first) {
    for (const IslandScratch::Near& near : local_.near) {
        const Plan::Chunk& chunk = plan_.chunks[near.chunk];
        report_.work += chunk.count;
        for (std::uint32_t i = chunk.first; i < chunk.first + chunk.count; ++i) {
            resolve_particle(i, near.collider, chunk.body, first);
        }
        // If links are longer than the collider is thick, it could slip through between two particles.
        if (chunk.reach <= scratch_.colliders[near.collider].size) continue;
        for (std::uint32_t l = 0; l < chunk.links; ++l) {
            const Link& link = state_.links[plan_.chunk_links[chunk.first_link + l]];
            resolve_link(link, near.collider, chunk.body);
        }
    }
}

void Substep::resolve_particle(std::uint32_t i, std::uint32_t number, std::uint32_t body, bool first) {
    if (scratch_.weight[i] == 0.0) return;
    const Scratch::Moving& collider = scratch_.colliders[number];
    const double radius = state_.bodies[body].radius;
    dvec3& x = scratch_.x[i];
    const dvec3 was = x;
    const double travelled = first ? detail::length(x - state_.position[i]) : 0.0;
    if (collider.far_from(x, radius + travelled)) return;
    const SurfaceDistance surface = first ? collider.sweep(state_.position[i], x, radius, report_.work)
                                          : surface_distance(*collider.shape, x);
    const double depth = radius - surface.distance;
    if (!(depth > 0.0)) return;
    record_impact(body, depth);
    x += depth * surface.normal;
    Touch& contact = touch(i, number, surface.normal);
    contact.record(number, x - was);
    if (detail::dot(contact.normal, surface.normal) < 0.9) return;  // a second surface
    contact.displacement += depth * surface.normal;
    apply_friction(i, body);
}

/// Records that a collider displaced a body by `depth`.
void Substep::record_impact(std::uint32_t body, double depth) {
    Scratch::Nearest& nearest = scratch_.body_near[body];
    if (depth > correction_speed * h_ && nearest == Scratch::Nearest::Resting)
        nearest = Scratch::Nearest::Impact;
}

void Substep::resolve_link(const Link& link, std::uint32_t number, std::uint32_t body) {
    const double radius = state_.bodies[body].radius;
    const Scratch::Moving& collider = scratch_.colliders[number];
    if (link.rest <= collider.size) return;
    dvec3 &a = scratch_.x[link.a], &b = scratch_.x[link.b];
    const std::optional<Scratch::Moving::At> at = collider.nearest({a, b}, radius, report_.work);
    if (!at) return;
    const double t = at->along;
    const SurfaceDistance surface = at->surface;
    const double depth = radius - surface.distance;
    const double share_a = scratch_.weight[link.a] * (1.0 - t), share_b = scratch_.weight[link.b] * t;
    const double shares = share_a * (1.0 - t) + share_b * t;
    if (!(depth > 0.0) || shares <= 0.0) return;
    record_impact(body, depth);
    const auto displace = [&](std::uint32_t i, double wanted) {
        // Next to a pinned end, the other end would have to move very far.
        const double by = std::min(wanted, 1.5 * depth);
        if (by <= 0.0) return;
        scratch_.x[i] += by * surface.normal;
        Touch& contact = touch(i, number, surface.normal);
        contact.record(number, by * surface.normal);
        if (detail::dot(contact.normal, surface.normal) < 0.9) return;
        contact.displacement += by * surface.normal;
        apply_friction(i, body);
    };
    displace(link.a, depth * share_a / shares);
    displace(link.b, depth * share_b / shares);
}

}  // namespace tendril::rope
