// Relaxation: one link after the other, repeatedly.
#include <algorithm>

#include "rope/body_contacts.hpp"
#include "rope/build.hpp"
#include "rope/geometry.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {

/// Moves both ends by their shares of the error; a pinned end stays.
void Substep::satisfy(std::uint32_t number, double compliance) {
    const Link& link = state_.links[number];
    const double weight_a = scratch_.weight[link.a], weight_b = scratch_.weight[link.b];
    if (weight_a + weight_b == 0.0) return;
    glm::dvec3 &a = scratch_.x[link.a], &b = scratch_.x[link.b];
    const glm::dvec3 by = b - a;
    const double length = detail::length(by), softness = compliance / (h_ * h_);
    const glm::dvec3 along = length > 1e-30 ? (1.0 / length) * by : glm::dvec3(1.0, 0.0, 0.0);
    const double error = length - link.rest - softness * scratch_.multiplier[number];
    const double change = error / (weight_a + weight_b + softness);
    scratch_.multiplier[number] += change;
    a += (weight_a * change) * along;
    b -= (weight_b * change) * along;
}

void Substep::satisfy_soft() {
    for (const std::uint32_t i : Plan::part(plan_.soft, island_.soft)) satisfy(i, state_.links[i].compliance);
}

void Substep::satisfy_ties() {
    for (const std::uint32_t i : Plan::part(plan_.ties, island_.ties)) {
        const Tie& tie = state_.ties[i];
        const double weight_a = scratch_.weight[tie.a], weight_b = scratch_.weight[tie.b];
        if (weight_a + weight_b == 0.0) continue;
        const glm::dvec3 by = scratch_.x[tie.b] - scratch_.x[tie.a];
        const double length = detail::length(by);
        if (length <= 1e-30) continue;
        const double change = (length - detail::enforced_length(tie, h_)) / (weight_a + weight_b);
        scratch_.tie_multiplier[i] += change;
        scratch_.x[tie.a] += (weight_a * change / length) * by;
        scratch_.x[tie.b] -= (weight_b * change / length) * by;
    }
}

/// A link stretched to more than twice its length was pulled apart by a collider that appeared. Correcting it
/// would throw the body.
void Substep::record_overstretch() {
    if (local_.near.empty()) return;
    for (const std::uint32_t i : Plan::part(plan_.links, island_.links)) {
        const Link& link = state_.links[i];
        const glm::dvec3 along = state_.position[link.b] - state_.position[link.a];
        const double twice = 2.0 * static_cast<double>(link.rest);
        if (link.kind != Link::Kind::Stretch || detail::dot(along, along) <= twice * twice) continue;
        const auto next = std::upper_bound(state_.bodies.begin(), state_.bodies.end(), link.a,
                                           [](std::size_t a, const Body& body) { return a < body.first; });
        record_impact(static_cast<std::uint32_t>(next - state_.bodies.begin() - 1),
                      detail::length(along) - link.rest);
    }
}

int Substep::relax() {
    record_overstretch();
    const std::span<const std::uint32_t> links = Plan::part(plan_.links, island_.links);
    for (const std::uint32_t i : links) scratch_.multiplier[i] = 0.0;
    for (const std::uint32_t i : Plan::part(plan_.ties, island_.ties)) scratch_.tie_multiplier[i] = 0.0;
    const int passes = passes_allowed();
    if (island_.contacts != 0) BodyContacts(*this).begin_projection(true);
    for (int pass = 0; pass < passes; ++pass) {
        report_.work += links.size() + island_.ties.count;
        resolve_contacts(pass == 0);
        if (island_.contacts != 0) BodyContacts(*this).project(true);
        for (const std::uint32_t i : links) {
            const Link& link = state_.links[i];
            if (link.kind != Link::Kind::Stretch) continue;
            satisfy(i, detail::compliance(state_.settings, link));
        }
        satisfy_soft();
        satisfy_ties();
    }
    measure();
    if (passes < state_.settings.iterations) report_.shortened = 1;
    return passes;
}

}  // namespace tendril::rope
