// The contacts of a cloth: of its particles, and of its links with colliders that fit between two particles.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "rope/cloth_solver.hpp"
#include "rope/contact_shape.hpp"
#include "rope/geometry.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// along n n^T + across (I - n n^T), in the order of GridBlocks.
std::array<double, 6> block(const dvec3& n, double along, double across) {
    const double by = along - across;
    return {by * n.x * n.x + across, by * n.x * n.y, by * n.x * n.z,
            by * n.y * n.y + across, by * n.y * n.z, by * n.z * n.z + across};
}
void add(const detail::GridBlocks& blocks, std::size_t cell, double factor,
         const std::array<double, 6>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) blocks[k][cell] += static_cast<float>(factor * values[k]);
}
void add(const detail::GridVector& vector, std::size_t cell, const dvec3& value) {
    vector[0][cell] += static_cast<float>(value.x);
    vector[1][cell] += static_cast<float>(value.y);
    vector[2][cell] += static_cast<float>(value.z);
}
dvec3 at(const detail::GridVector& vector, std::size_t cell) {
    return {vector[0][cell], vector[1][cell], vector[2][cell]};
}

}  // namespace

/// Finds what is inside a collider, and what pressed in the previous solve. Always in the same order.
void ClothSolver::find_contacts(bool first) {
    std::vector<ClothContact>&found = local_.cloth_contacts, &before = local_.earlier_contacts;
    std::swap(found, before);
    found.clear();
    if (first) before.clear();
    auto earlier = before.begin();
    const auto force_before = [&](const ClothContact& contact) {
        const bool known = earlier != before.end() && earlier->near == contact.near &&
                           earlier->a == contact.a && earlier->b == contact.b;
        return known ? (earlier++)->force : 0.0;
    };
    const double radius = state_.bodies[grid_.body].radius;
    for (std::uint32_t n = 0; n < local_.near.size(); ++n) {
        const Plan::Chunk& chunk = plan_.chunks[local_.near[n].chunk];
        local_.done.work += chunk.count;
        for (std::uint32_t i = chunk.first; i < chunk.first + chunk.count; ++i) {
            ClothContact contact{.near = n, .a = i, .b = i};
            contact.force = force_before(contact);
            find_at_particle(contact, radius, first);
        }
        const double size = scratch_.colliders[local_.near[n].collider].size;
        if (chunk.reach <= size) continue;
        for (std::uint32_t l = 0; l < chunk.links; ++l) {
            const std::uint32_t number = plan_.chunk_links[chunk.first_link + l];
            const Link& link = state_.links[number];
            ClothContact contact{.near = n, .a = link.a, .b = link.b, .link = number};
            contact.force = force_before(contact);
            if (link.rest > size) find_at_link(contact, radius);
        }
    }
}

void ClothSolver::find_at_particle(ClothContact contact, double radius, bool first) {
    const std::uint32_t i = contact.a;
    if (scratch_.weight[i] == 0.0) return;
    const Scratch::Moving& collider = collider_of(contact);
    dvec3& place = scratch_.place[i];
    const double travelled = first ? detail::length(place - state_.position[i]) : 0.0;
    if (collider.far_from(place, radius + travelled)) return;
    keep(contact,
         first ? collider.entered(state_.position[i], place, radius, local_.done.work)
               : surface_distance(*collider.shape, place),
         radius);
}

void ClothSolver::find_at_link(ClothContact contact, double radius) {
    const Scratch::Moving& collider = collider_of(contact);
    const dvec3 a = scratch_.place[contact.a], b = scratch_.place[contact.b], along = b - a;
    if (scratch_.weight[contact.a] + scratch_.weight[contact.b] == 0.0) return;
    if (collider.far_from(a + 0.5 * along, radius + 0.5 * detail::length(along))) return;
    local_.done.work += detail::max_line_samples;
    const std::optional<double> t = detail::nearest_between(*collider.shape, a, b, radius);
    if (!t) return;
    contact.t = *t;
    keep(contact, surface_distance(*collider.shape, a + *t * along), radius);
}

void ClothSolver::keep(ClothContact contact, const SurfaceDistance& surface, double radius) {
    contact.gap = surface.distance - radius;
    contact.normal = surface.normal;
    const bool presses = contact.force > 0.0;
    if (contact.gap >= 0.0 && !presses) return;
    // Initially the force that lifts it out.
    if (!presses) contact.force = -contact.gap * state_.mass[contact.a] / mass_;
    local_.cloth_contacts.push_back(contact);
}

void ClothSolver::add_contacts() {
    for (ClothContact& each : local_.cloth_contacts) {
        rub(each);
        add_contact(each);
    }
}

/// Friction, from the normal force of the previous step.
void ClothSolver::rub(ClothContact& contact) const {
    const dvec3& n = contact.normal;
    contact.at = between(contact, scratch_.place);
    dvec3& slip = contact.slip;
    slip = contact.at - between(contact, state_.position) - collider_of(contact).by_at(contact.at);
    slip -= detail::dot(slip, n) * n;
    const double size = detail::length(slip), most = state_.settings.friction * contact.force;
    contact.drag = size * stiffness_ > most ? most / size : stiffness_;
}

/// The contact's share of the potential.
double ClothSolver::potential_of(const ClothContact& contact) const {
    const dvec3 by = between(contact, scratch_.place) - contact.at;
    const double along = detail::dot(by, contact.normal), gap = contact.gap + along;
    const dvec3 slip = contact.slip + by - along * contact.normal;
    return stiffness_ * gap * gap + contact.drag * detail::dot(slip, slip);
}

void ClothSolver::add_contact(const ClothContact& contact) {
    const dvec3& n = contact.normal;
    const double to_b = contact.t, to_a = 1.0 - to_b;
    const std::array<double, 6> stiff = block(n, stiffness_, contact.drag);
    const dvec3 force = -stiffness_ * contact.gap * n - contact.drag * contact.slip;
    const std::size_t cell_a = cell_of(contact.a);
    add(level_.diagonal, cell_a, to_a * to_a, stiff);
    add(level_.right, cell_a, to_a * force);
    if (!contact.is_link()) return;
    const std::size_t cell_b = cell_of(contact.b);
    add(level_.diagonal, cell_b, to_b * to_b, stiff);
    add(level_.right, cell_b, to_b * force);
    const std::span<const std::uint32_t> links = Plan::part(plan_.links, island_.links);
    const auto found = std::lower_bound(links.begin(), links.end(), contact.link) - links.begin();
    const Plan::GridLink& link = plan_.grid_links[grid_.links.first + static_cast<std::size_t>(found)];
    add(level_.links[link.step], link.cell, -to_a * to_b, stiff);
}

/// Stores the force of each contact after a solve.
void ClothSolver::note_forces() {
    const detail::GridVector& by = cloth_.system.solution();
    for (ClothContact& each : local_.cloth_contacts) {
        const dvec3 moved = (1.0 - each.t) * at(by, cell_of(each.a)) + each.t * at(by, cell_of(each.b));
        each.force = -stiffness_ * (each.gap + taken_ * detail::dot(each.normal, moved));
    }
}

}  // namespace tendril::rope
