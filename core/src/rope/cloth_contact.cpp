// The contacts of a cloth.
#include <algorithm>
#include <cmath>

#include "rope/cloth_solver.hpp"
#include "rope/geometry.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// Adds along n n^T + across (I - n n^T) to a block of the diagonal.
void add_block(const detail::GridLevel& level, std::size_t cell, const dvec3& n, double along,
               double across) {
    const double by = along - across;
    const double values[] = {by * n.x * n.x + across, by * n.x * n.y,          by * n.x * n.z,
                             by * n.y * n.y + across, by * n.y * n.z, by * n.z * n.z + across};
    for (std::size_t k = 0; k < 6; ++k) level.diagonal[k][cell] += static_cast<float>(values[k]);
}

}  // namespace

/// What is inside a collider, and what pressed in the solve before. They are found in the same order each time.
void ClothSolver::find_contacts(bool first) {
    std::vector<ClothContact>&found = local_.cloth_contacts, &before = local_.earlier_contacts;
    std::swap(found, before);
    found.clear();
    if (first) before.clear();
    auto earlier = before.begin();
    const double radius = state_.bodies[grid_.body].radius;
    for (std::uint32_t n = 0; n < local_.near.size(); ++n) {
        const Plan::Chunk& chunk = plan_.chunks[local_.near[n].chunk];
        local_.done.work += chunk.count;
        for (std::uint32_t i = chunk.first; i < chunk.first + chunk.count; ++i) {
            const bool known = earlier != before.end() && earlier->near == n && earlier->particle == i;
            find_contact({.near = n, .particle = i, .force = known ? (earlier++)->force : 0.0}, radius, first);
        }
    }
}

void ClothSolver::find_contact(ClothContact contact, double radius, bool first) {
    const std::uint32_t i = contact.particle;
    if (scratch_.weight[i] == 0.0) return;
    const Scratch::Moving& collider = scratch_.colliders[local_.near[contact.near].collider];
    dvec3& place = scratch_.place[i];
    const double travelled = first ? detail::length(place - state_.position[i]) : 0.0;
    if (collider.far_from(place, radius + travelled)) return;
    const SurfaceDistance surface = first ? collider.entered(state_.position[i], place, radius, local_.done.work)
                                          : surface_distance(*collider.shape, place);
    contact.gap = surface.distance - radius;
    if (contact.gap >= 0.0 && !(contact.force > 0.0)) return;
    contact.normal = surface.normal;
    // At first as much as lifts it out.
    if (!(contact.force > 0.0)) contact.force = std::max(0.0, -contact.gap) * state_.mass[i] / mass_;
    local_.cloth_contacts.push_back(contact);
}

void ClothSolver::add_contacts() {
    const double friction = state_.settings.friction;
    for (const ClothContact& each : local_.cloth_contacts) {
        const std::size_t cell = cell_of(each.particle);
        const dvec3& n = each.normal;
        const Scratch::Moving& collider = scratch_.colliders[local_.near[each.near].collider];
        const dvec3& place = scratch_.place[each.particle];
        dvec3 slip = place - state_.position[each.particle] - collider.by_at(place);
        slip -= detail::dot(slip, n) * n;
        const double size = detail::length(slip), most = friction * each.force;
        const double drag = size * stiffness_ > most ? most / size : stiffness_;
        add_block(level_, cell, n, stiffness_, drag);
        const dvec3 right = -stiffness_ * each.gap * n - drag * slip;
        level_.right[0][cell] += static_cast<float>(right.x);
        level_.right[1][cell] += static_cast<float>(right.y);
        level_.right[2][cell] += static_cast<float>(right.z);
    }
}

/// How much each contact presses after a solve.
void ClothSolver::note_forces() {
    const detail::GridVector& by = cloth_.system.solution();
    for (ClothContact& each : local_.cloth_contacts) {
        const std::size_t cell = cell_of(each.particle);
        const dvec3 moved(by[0][cell], by[1][cell], by[2][cell]);
        each.force = -stiffness_ * (each.gap + detail::dot(each.normal, moved));
    }
}

}  // namespace tendril::rope
