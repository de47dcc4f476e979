// Measurements of a world.
#include <algorithm>
#include <cmath>

#include "rope/build.hpp"
#include "rope/geometry.hpp"
#include "rope/rest_grid.hpp"
#include "rope/slots.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::rope {
namespace {

double particle_energy(const State& state, std::size_t first, std::size_t count) {
    const glm::dvec3 acceleration = detail::acceleration(state.settings);
    double energy = 0.0;
    for (std::size_t i = first; i < first + count; ++i) {
        const glm::dvec3 halfway = state.position[i] - 0.5 * state.displacement[i];
        energy += detail::kinetic_energy(state.mass[i], state.displacement[i], state.displaced_in) -
                  state.mass[i] * detail::dot(acceleration, halfway);
    }
    return energy;
}

double link_energy(const State& state, const Link& link) {
    const double compliance = detail::compliance(state.settings, link);
    if (compliance == 0.0) return 0.0;
    return detail::elastic_energy(link, compliance, link.tension,
                                  state.position[link.b] - state.position[link.a],
                                  state.displacement[link.b] - state.displacement[link.a]);
}

/// The mean at both ends of the last substep.
double bending_energy(const State& state, const Body& body) {
    double sum = 0.0;
    for (std::size_t i = 1; detail::bends(state, body) && i < state.links.size(); ++i) {
        const Link &link = state.links[i], &last = state.links[i - 1];
        if (!detail::owns(body, link) || !detail::follows(last, link)) continue;
        for (const double back : {0.0, 1.0})
            sum += 0.5 * detail::bending_energy(state, body, last, link, [&](std::uint32_t p) {
                       return state.position[p] - back * state.displacement[p];
                   });
    }
    return sum;
}

}  // namespace

double detail::length_error(const State& state, const Link& link) noexcept {
    if (link.kind != Link::Kind::Stretch) return 0.0;
    const double length = detail::length(state.position[link.b] - state.position[link.a]);
    const double rest = link.rest;
    return rest > 0.0 ? std::abs(length / rest - 1.0) : length;
}

glm::dvec3 World::velocity(std::size_t particle) const noexcept {
    if (state_.displaced_in <= 0.0) return glm::dvec3(0.0);
    return (1.0 / state_.displaced_in) * state_.displacement[particle];
}

double World::length_error(const Body& body) const noexcept {
    double worst = 0.0;
    for (const Link& link : state_.links)
        if (detail::owns(body, link)) worst = std::max(worst, detail::length_error(state_, link));
    return worst;
}

double World::length_error() const noexcept {
    double worst = 0.0;
    for (const Link& link : state_.links) worst = std::max(worst, detail::length_error(state_, link));
    return worst;
}

double World::energy(const Body& body) const noexcept {
    double energy = particle_energy(state_, body.first, body.count);
    for (const Link& link : state_.links)
        if (detail::owns(body, link)) energy += link_energy(state_, link);
    return energy + bending_energy(state_, body);
}

double World::energy() const noexcept {
    double energy = particle_energy(state_, 0, state_.position.size());
    for (const Link& link : state_.links) energy += link_energy(state_, link);
    for (const Body& body : state_.bodies) energy += bending_energy(state_, body);
    return energy;
}

double World::length(const Body& body) const {
    if (body.kind == Body::Kind::Cloth) return detail::rest_grid(state_, body).length();
    double sum = 0.0;
    for (const Link& link : state_.links) {
        const bool row = link.a - body.first + 1 < body.row && link.b == link.a + 1;
        if (link.kind == Link::Kind::Stretch && detail::owns(body, link) && row) sum += link.rest;
    }
    return sum;
}

}  // namespace tendril::rope
