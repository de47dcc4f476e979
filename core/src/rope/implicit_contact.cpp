// Contacts in an implicit step: of particles, and of links with colliders that fit between two particles.
#include <algorithm>
#include <cmath>
#include <optional>

#include "rope/contact_shape.hpp"
#include "rope/geometry.hpp"
#include "rope/implicit_step.hpp"

namespace tendril::rope {
using glm::dvec3;

/// Finds contacts that penetrate, or that pressed in the previous solve; always in the same order.
void ImplicitStep::find_contacts(bool first) {
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
    for (std::uint32_t n = 0; n < local_.near.size(); ++n) {
        const Plan::Chunk& chunk = plan_.chunks[local_.near[n].chunk];
        const double radius = state_.bodies[chunk.body].radius;
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
            if (link.rest > size) find_at_link(contact, radius, first);
        }
    }
}

void ImplicitStep::find_at_particle(ClothContact contact, double radius, bool first) {
    const std::uint32_t i = contact.a;
    if (scratch_.weight[i] == 0.0) return;
    const Scratch::Moving& collider = collider_of(contact);
    dvec3& x = scratch_.x[i];
    const double travelled = first ? detail::length(x - state_.position[i]) : 0.0;
    if (collider.far_from(x, radius + travelled)) return;
    add_if_active(contact,
                  first ? collider.sweep(state_.position[i], x, radius, local_.done.work)
                        : surface_distance(*collider.shape, x),
                  radius, first);
}

void ImplicitStep::find_at_link(ClothContact contact, double radius, bool first) {
    const Scratch::Moving& collider = collider_of(contact);
    if (scratch_.weight[contact.a] + scratch_.weight[contact.b] == 0.0) return;
    const auto at =
        collider.nearest({scratch_.x[contact.a], scratch_.x[contact.b]}, radius, local_.done.work);
    if (!at) return;
    contact.t = at->along;
    add_if_active(contact, at->surface, radius, first);
}

/// Adds a contact that penetrates or pressed before; in the first solve, also if it would on the free path.
void ImplicitStep::add_if_active(ClothContact contact, const SurfaceDistance& surface, double radius,
                                 bool first) {
    contact.gap = surface.distance - radius;
    contact.normal = surface.normal;
    double depth = -contact.gap;
    if (first) {
        const dvec3 free_move = contact_point(contact, scratch_.base) - contact_point(contact, scratch_.x);
        depth = std::max(depth, depth - detail::dot(contact.normal, free_move));
    }
    const bool pressed_before = contact.force > 0.0;
    if (depth <= 0.0 && !pressed_before) return;
    if (!pressed_before) contact.force = depth * state_.mass[contact.a] / mass_;
    local_.cloth_contacts.push_back(contact);
}

/// Friction, from the normal force of the previous step.
void ImplicitStep::apply_friction(ClothContact& contact) const {
    const dvec3& n = contact.normal;
    contact.at = contact_point(contact, scratch_.x);
    dvec3& slip = contact.slip;
    slip = contact.at - contact_point(contact, state_.position) - collider_of(contact).move_at(contact.at);
    slip -= detail::dot(slip, n) * n;
    const double size = detail::length(slip), limit = friction_of(contact) * contact.force;
    contact.drag = size * stiffness_ > limit ? limit / size : stiffness_;
}

/// The contact's share of the potential.
double ImplicitStep::potential_of(const ClothContact& contact) const {
    const dvec3 by = contact_point(contact, scratch_.x) - contact.at;
    const double along = detail::dot(by, contact.normal), gap = contact.gap + along;
    const dvec3 slip = contact.slip + by - along * contact.normal;
    return stiffness_ * gap * gap + contact.drag * detail::dot(slip, slip);
}

}  // namespace tendril::rope
