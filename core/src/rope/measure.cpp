// What can be read off a world.
#include <algorithm>
#include <cmath>

#include "rope/build.hpp"
#include "rope/geometry.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::rope {
namespace {

bool within(const Body& body, const Link& link) {
    return link.a >= body.first && link.a - body.first < body.count;
}

}  // namespace

glm::vec3 World::velocity(std::size_t particle) const noexcept {
    if (state_.moved_in <= 0.0) return glm::vec3(0.0f);
    return glm::vec3((1.0 / state_.moved_in) * state_.moved[particle]);
}

double World::length_error(const Body& body) const noexcept {
    double worst = 0.0;
    for (const Link& link : state_.links) {
        if (link.kind != Link::Kind::Stretch || !within(body, link)) continue;
        const double length = detail::length(state_.position[link.b] - state_.position[link.a]);
        const double rest = link.rest;
        worst = std::max(worst, rest > 0.0 ? std::abs(length / rest - 1.0) : length);
    }
    return worst;
}

double World::energy(const Body& body) const noexcept {
    const glm::dvec3 acceleration = detail::acceleration(state_.settings);
    const double rate = state_.moved_in > 0.0 ? 0.5 / state_.moved_in : 0.0;
    double energy = 0.0;
    for (std::size_t i = body.first; i < body.first + body.count; ++i) {
        const glm::dvec3 velocity = rate * (state_.moved[i] + state_.before[i]);
        const glm::dvec3 then = state_.position[i] - state_.moved[i];
        energy += state_.mass[i] * (0.5 * detail::dot(velocity, velocity) - detail::dot(acceleration, then));
    }
    for (const Link& link : state_.links) {
        if (!within(body, link)) continue;
        const bool stretches =
            link.kind == Link::Kind::Stretch && state_.settings.solver != Solver::Relaxation;
        const double give =
            link.compliance + (stretches ? static_cast<double>(state_.settings.compliance) * link.rest : 0.0);
        energy += 0.5 * give * link.tension * link.tension;
    }
    return energy;
}

double World::length(const Body& body) const noexcept {
    double sum = 0.0;
    for (const Link& link : state_.links) {
        const bool row = link.a - body.first + 1 < body.row && link.b == link.a + 1;
        if (link.kind == Link::Kind::Stretch && within(body, link) && row) sum += link.rest;
    }
    return sum;
}

}  // namespace tendril::rope
