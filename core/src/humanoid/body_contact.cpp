// A body's capsules in its solve: finding those near each other, and the equations of those that touch.
#include <algorithm>

#include "humanoid/body_solve.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid::detail {

using namespace rig::detail;

void BodySolve::find_contacts() noexcept {
    contact_count_ = 0;
    if (!collides_) return;
    const auto placed = [&](const Volume& volume) {
        const Link& link = work_.links[static_cast<std::size_t>(volume.link)];
        return PlacedCapsule{plus(link.position, rotated(link.rotation, volume.from)),
                             plus(link.position, rotated(link.rotation, volume.to)), volume.capsule.radius};
    };
    for (const Pair& pair : work_.pairs) {
        const Nearest at = nearest(placed(work_.volumes[pair.first]), placed(work_.volumes[pair.second]));
        const glm::dvec3 offset = minus(at.first, at.second);
        const double distance = length(offset);
        Contact contact{&pair, at.first, at.second, {0.0, 0.0, 1.0}, distance - pair.min_distance};
        if (contact.gap > contact_range * work_.size) continue;
        if (distance > 1e-9) contact.normal = times(offset, 1.0 / distance);
        if (contact_count_ < max_contacts) {
            contacts_[contact_count_++] = contact;
            continue;
        }
        Contact& widest = *std::max_element(contacts_.begin(), contacts_.end(),
                                            [](const Contact& a, const Contact& b) { return a.gap < b.gap; });
        if (contact.gap < widest.gap) widest = contact;
    }
}

double BodySolve::contact_cost() const noexcept {
    double cost = 0.0;
    for (std::size_t c = 0; c < contact_count_; ++c) {
        const double deep = std::min(contacts_[c].gap, 0.0);
        cost += 0.5 * contact_weight * deep * deep;
    }
    return cost;
}

double BodySolve::deepest() const noexcept {
    double deepest = 0.0;
    for (std::size_t c = 0; c < contact_count_; ++c) deepest = std::max(deepest, -contacts_[c].gap);
    return deepest;
}

glm::dvec3 BodySolve::contact_column(const Contact& contact, std::size_t link) const noexcept {
    const bool first = work_.volumes[contact.pair->first].moved_by >> link & 1u;
    const bool second = work_.volumes[contact.pair->second].moved_by >> link & 1u;
    if (first == second) return glm::dvec3(0.0);
    const glm::dvec3& point = first ? contact.first : contact.second;
    const glm::dvec3 column = cross(minus(point, work_.links[link].position), contact.normal);
    return first ? column : times(column, -1.0);
}

void BodySolve::add_contact_row(Contact& contact) noexcept {
    contact.row = static_cast<int>(row_count_);
    rows_[row_count_] = {glm::dvec3(0.0), -contact.gap, contact_weight};
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        columns_[i][row_count_] = contact_column(contact, i);
        if (columns_[i][row_count_] != glm::dvec3(0.0)) steps_[i].rows |= 1u << row_count_;
    }
    ++row_count_;
}

bool BodySolve::update_contacts() noexcept {
    bool changed = false;
    for (std::size_t c = 0; c < contact_count_; ++c) {
        Contact& contact = contacts_[c];
        if (contact.row >= 0) {
            const auto row = static_cast<std::size_t>(contact.row);
            if (contact.released || forces_[row] >= 0.0) continue;
            rows_[row].weight = released_contact_weight;
            contact.released = changed = true;
            continue;
        }
        double gap = contact.gap;
        for (std::size_t i = 0; i < work_.links.size(); ++i)
            if (work_.links[i].effectors != 0) gap += dot(contact_column(contact, i), steps_[i].turn);
        if (gap >= -1e-9 * work_.size) continue;
        add_contact_row(contact);
        changed = true;
    }
    return changed;
}

}  // namespace tendril::humanoid::detail
