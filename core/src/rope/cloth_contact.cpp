// The contacts of a cloth in its system: with colliders, and with itself.
#include <algorithm>
#include <array>

#include "rope/body_contacts.hpp"
#include "rope/cloth_solver.hpp"
#include "rope/geometry.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// Stiffness of a contact within the cloth, in m / h^2: it carries a hundred times the weight of a particle
/// with a gap of a few micrometres.
constexpr double self_contact_stiffness = 300.0;

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

}  // namespace

void ClothSolver::add_contacts() {
    for (ClothContact& each : local_.cloth_contacts) {
        apply_friction(each);
        add_contact(each);
    }
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
    const std::span<const Plan::GridLink> links = Plan::part(plan_.grid_links, grid_.links);
    const Plan::GridLink& link = *std::ranges::lower_bound(links, contact.link, {}, &Plan::GridLink::link);
    add(level_.links[link.step], link.cell, -to_a * to_b, stiff);
}

void ClothSolver::find_self_contacts() {
    local_.self_contacts.clear();
    if (island_.contacts == 0) return;
    const Body& body = state_.bodies[grid_.body];
    BodyContacts(*this).find_self_contacts(body, self_contact_stiffness * mass_, local_.self_contacts);
}

void ClothSolver::add_self_contacts() {
    std::vector<detail::GridCoupling>& to = cloth_.system.couplings();
    to.clear();
    const double unit = 1.0 / mass_;
    for (const ClothSelfContact& each : local_.self_contacts) {
        detail::GridCoupling coupling{.along = static_cast<float>(unit * each.along),
                                      .across = static_cast<float>(unit * each.across)};
        const dvec3 force = -unit * (each.along * each.gap * each.normal + each.across * each.slip);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t cell = cell_of(each.points[k]);
            coupling.cells[k] = static_cast<std::uint32_t>(cell);
            coupling.weights[k] = level_.free[cell] * static_cast<float>(each.weights[k]);
            add(level_.right, cell, each.weights[k] * force);
        }
        for (std::size_t c = 0; c < 3; ++c)
            coupling.normal[c] = static_cast<float>(each.normal[static_cast<int>(c)]);
        to.push_back(coupling);
    }
}

double ClothSolver::self_contact_potential() const {
    double sum = 0.0;
    for (const ClothSelfContact& each : local_.self_contacts) {
        dvec3 by = -each.at;
        for (std::size_t k = 0; k < 4; ++k) by += each.weights[k] * scratch_.x[each.points[k]];
        const double along = detail::dot(by, each.normal), gap = each.gap + along;
        const dvec3 slip = each.slip + by - along * each.normal;
        sum += each.along * gap * gap + each.across * detail::dot(slip, slip);
    }
    return sum / mass_;
}

/// Stores the force of each contact after a solve.
void ClothSolver::store_forces() {
    for (ClothContact& each : local_.cloth_contacts) {
        const dvec3 moved = contact_point(each, scratch_.x) - each.at;
        each.force = -stiffness_ * (each.gap + detail::dot(each.normal, moved));
    }
}

/// The depth of the deepest contact in a collider.
double ClothSolver::deepest() const {
    double depth = 0.0;
    for (const ClothContact& each : local_.cloth_contacts) depth = std::max(depth, -each.gap);
    return depth;
}

}  // namespace tendril::rope
